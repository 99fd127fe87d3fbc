#include "core/diagnosis/steady_error.hpp"

#include "core/hos/segments.hpp"
#include "core/signal/setpoint_steps.hpp"

namespace loopscope::core {

SteadyError steady_error(const signal::PreparedLoop& loop, const hos::Settings& settings) {
  signal::ErrorBetweenSteps between = signal::error_between_steps(loop);
  if (between.steps == 0) return {loop.error, nullptr};
  const bool enough = hos::segment_starts(between.error, settings).size() >= kMinSegments;
  if (!enough || between.masked_fraction <= 0.0) return {loop.error, "sp_moving"};
  return {std::move(between.error), "sp_steps_masked"};
}

}  // namespace loopscope::core
