#include "core/diagnosis/steady_error.hpp"

#include <utility>

#include "core/hos/draw_missing.hpp"
#include "core/hos/segments.hpp"
#include "core/signal/setpoint_steps.hpp"

namespace loopscope::core {
namespace {

SteadyError without_steps(const signal::PreparedLoop& loop, const hos::Settings& settings) {
  signal::ErrorBetweenSteps between = signal::error_between_steps(loop);
  if (between.steps == 0) return {std::move(between.error), nullptr};
  const bool enough = hos::segment_starts(between.error, settings).size() >= kMinSegments;
  if (enough && between.masked_fraction > 0.0) {
    return {std::move(between.error), "sp_steps_masked"};
  }
  return {loop.drawable.error.empty() ? loop.error : loop.drawable.error, "sp_moving"};
}

}  // namespace

SteadyError steady_error(const signal::PreparedLoop& loop, const hos::Settings& settings,
                         std::uint64_t seed) {
  SteadyError steady = without_steps(loop, settings);
  if (!loop.drawable.low.empty()) {
    steady.error = hos::draw_missing(steady.error, {loop.drawable.low, loop.drawable.high}, seed);
  }
  return steady;
}

}  // namespace loopscope::core
