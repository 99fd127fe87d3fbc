#include "core/signal/op_scale.hpp"

#include <algorithm>
#include <cmath>

#include "core/signal/spread.hpp"

namespace loopscope::core::signal {
namespace {

/// Controllers stop a little before their limits and converters add noise: within half a percent
/// the valve is as good as at its stop.
constexpr double kLimitBand = 0.5;

}  // namespace

std::optional<OpRange> resolve_op_range(std::span<const double> op,
                                        const std::optional<OpRange>& given) {
  if (given) return given;
  const std::optional<Spread> spread = measure_spread(op);
  const bool fits = spread && spread->low >= 0.0 && spread->high <= 100.0;
  return fits ? std::optional(OpRange{}) : std::nullopt;
}

Samples to_percent(Samples samples, const std::optional<OpRange>& range) {
  if (!range) return samples;
  for (double& value : samples) value = (value - range->low) / (range->high - range->low) * 100.0;
  return samples;
}

std::optional<double> fraction_at_limit(std::span<const double> percent) {
  std::size_t recorded = 0;
  std::size_t at_limit = 0;
  for (const double value : percent) {
    if (!std::isfinite(value)) continue;
    ++recorded;
    if (value <= kLimitBand || value >= 100.0 - kLimitBand) ++at_limit;
  }
  if (recorded == 0) return std::nullopt;
  return static_cast<double>(at_limit) / static_cast<double>(recorded);
}

}  // namespace loopscope::core::signal
