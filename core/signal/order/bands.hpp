#pragma once

#include <cmath>
#include <cstddef>
#include <span>

namespace loopscope::core::signal {

/// Bands of equal width between the extremes of some values, at least one and no NaN. A larger
/// value never has a lower band, whatever rounding does.
class Bands {
 public:
  /// `count`: number of bands, >= 2.
  Bands(std::span<const double> values, std::size_t count) {
    double high = values[0];
    low_ = values[0];
    for (const double value : values) {
      low_ = value < low_ ? value : low_;
      high = value > high ? value : high;
    }
    scale_ = static_cast<double>(count - 1) / (high - low_);
  }

  /// False when all values are equal, or their distance is out of the range of numbers.
  [[nodiscard]] bool usable() const { return std::isfinite(scale_) && scale_ > 0.0; }

  /// 0 to count - 1; of a value between the extremes, where usable().
  [[nodiscard]] std::size_t of(double value) const {
    return static_cast<std::size_t>((value - low_) * scale_);
  }

 private:
  double low_ = 0.0;
  double scale_ = 0.0;
};

}  // namespace loopscope::core::signal
