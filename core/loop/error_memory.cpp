#include "core/loop/error_memory.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/loop/correlation.hpp"

namespace loopscope::core::loop {
namespace {

/// White noise of the sensor, and what the sampling makes of it, is over by then.
constexpr std::size_t kPastNoise = 3;
/// Ten standard deviations of an autocorrelation of 4096 white samples are 0.16; below 0.1 the
/// fall to 1/e is lost in them.
constexpr double kLeastAutocorrelation = 0.1;

}  // namespace

std::optional<double> error_memory_samples(std::span<const double> error) {
  const std::size_t longest = error.size() / 4;
  if (longest <= kPastNoise) return std::nullopt;
  RealTransform transform(fast_length(error.size() + longest));
  const std::vector<double> r = autocorrelate(error, longest, transform);
  if (r.size() <= kPastNoise || r[kPastNoise] < kLeastAutocorrelation) return std::nullopt;
  const auto forgotten = std::find_if(
      r.begin() + kPastNoise, r.end(),
      [limit = r[kPastNoise] * std::exp(-1.0)](double value) { return value <= limit; });
  return static_cast<double>(forgotten - r.begin());
}

}  // namespace loopscope::core::loop
