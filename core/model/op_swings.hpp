#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace loopscope::core::model {

/// Samples of a full cycle of op, counting only turns after which op moves by more than
/// `swing_percent`: twice the length over the number of such turns; infinite when there is none.
/// op without NaN.
[[nodiscard]] double swing_period(std::span<const double> op, double swing_percent);

/// Where op turns, for swings of more than `least_percent`: enough to find the period of any wider
/// swing without going through op again.
class OpSwings {
 public:
  OpSwings(std::span<const double> op, double least_percent);

  /// swing_period(op, swing_percent), swing_percent >= least_percent.
  [[nodiscard]] double period(double swing_percent) const;

 private:
  std::size_t samples_;
  std::vector<double> extremes_;
};

}  // namespace loopscope::core::model
