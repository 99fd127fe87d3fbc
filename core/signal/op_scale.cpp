#include "core/signal/op_scale.hpp"

#include <algorithm>
#include <cmath>

#include "core/signal/control_state.hpp"
#include "core/signal/flat_run.hpp"
#include "core/signal/order/spread.hpp"

namespace loopscope::core::signal {
namespace {

constexpr double kLimitBand = 0.5;
/// A signal that only touches its largest value takes it once or twice in a row.
constexpr std::size_t kHeldSamples = 3;

std::optional<double> share_of_recorded(std::size_t part, std::span<const double> samples) {
  const auto recorded = std::ranges::count_if(samples, [](double v) { return std::isfinite(v); });
  if (recorded == 0) return std::nullopt;
  return static_cast<double>(part) / static_cast<double>(recorded);
}

}  // namespace

Samples to_percent(Samples samples, const std::optional<OpRange>& range) {
  if (!range) return samples;
  for (double& value : samples) value = (value - range->low) / (range->high - range->low) * 100.0;
  return samples;
}

bool at_end(double percent) {
  return percent <= kLimitBand || percent >= 100.0 - kLimitBand;
}

std::optional<double> fraction_at_limit(std::span<const double> percent) {
  const auto at_limit = std::ranges::count_if(
      percent, [](double value) { return std::isfinite(value) && at_end(value); });
  return share_of_recorded(static_cast<std::size_t>(at_limit), percent);
}

std::optional<double> fraction_held_at_limit(std::span<const double> percent,
                                             std::span<const double> error) {
  const std::optional<Spread> spread = measure_spread(percent);
  if (!spread) return std::nullopt;
  std::size_t held = 0;
  for (const FlatRun& run : flat_runs(percent)) {
    const bool extreme = run.value == spread->high || run.value == spread->low;
    if (!extreme || !at_end(run.value) || run.samples < kHeldSamples) continue;
    if (keeps_its_sign(error.subspan(run.first, run.samples))) held += run.samples;
  }
  return share_of_recorded(held, percent);
}

}  // namespace loopscope::core::signal
