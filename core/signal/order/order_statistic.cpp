#include "core/signal/order/order_statistic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace loopscope::core::signal {
namespace {

/// Fewer are done with by comparisons at once.
constexpr std::size_t kFewestForBands = 100;
/// So that a band holds a handful of a window's values.
constexpr std::size_t kBands = 1024;

double select(std::vector<double> values, std::size_t rank) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Bands of equal width between the extremes. A larger value never has a lower band, whatever
/// rounding does.
class Bands {
 public:
  explicit Bands(std::span<const double> values) {
    double high = values[0];
    low_ = values[0];
    for (const double value : values) {
      low_ = value < low_ ? value : low_;
      high = value > high ? value : high;
    }
    scale_ = static_cast<double>(kBands - 1) / (high - low_);
  }
  /// False when all values are equal, or their distance is out of the range of numbers.
  [[nodiscard]] bool usable() const { return std::isfinite(scale_) && scale_ > 0.0; }
  [[nodiscard]] std::size_t of(double value) const {
    return static_cast<std::size_t>((value - low_) * scale_);
  }

 private:
  double low_ = 0.0;
  double scale_ = 0.0;
};

}  // namespace

double order_statistic(std::span<const double> values, std::size_t rank) {
  const Bands bands(values);
  if (values.size() < kFewestForBands || !bands.usable()) {
    return select({values.begin(), values.end()}, rank);
  }
  std::array<std::uint32_t, kBands> counts{};
  for (const double value : values) ++counts[bands.of(value)];
  std::size_t below = 0;
  std::size_t band = 0;
  while (below + counts[band] <= rank) below += counts[band++];
  std::vector<double> inside;
  inside.reserve(counts[band]);
  for (const double value : values) {
    if (bands.of(value) == band) inside.push_back(value);
  }
  return select(std::move(inside), rank - below);
}

double median(std::span<const double> values) {
  return order_statistic(values, values.size() / 2);
}

}  // namespace loopscope::core::signal
