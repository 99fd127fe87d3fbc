#include "core/diagnosis/implied_tuning.hpp"

#include <cmath>

namespace loopscope::core::diagnosis {
namespace {

/// Textbooks ask for a peak sensitivity of 1.2 to 2 (Astrom and Hagglund); the fitted loop is known
/// to some ten percent, and 2.5 is bad whatever it is exactly.
constexpr double kPoorSensitivity = 2.5;
/// Quarter-amplitude decay, the most oscillatory tuning that was ever recommended, has 0.22.
constexpr double kPoorDamping = 0.2;
/// Loops 10 % below the edge of stability have 0.05 and more (tests/effects).
constexpr double kNoDamping = 0.02;
/// The period of a noise-driven resonance wanders, and so do fitted poles.
constexpr double kNearPeriod = 1.25;
/// Integral action so many times weaker than the SIMC rules give: of 1000 fine loops with the
/// process 20 % off one passes, of 717 truly slow ones 716 (core/model/README.closed_loop.md).
constexpr double kSluggish = 4.0;
/// Lambda tuning's most careful advice, a closed loop three times as slow as the process, comes to
/// 3 to 4; a dead time counts twice in it.
constexpr double kSlowerThanItself = 4.0;

}  // namespace

bool poorly_damped(const model::ClosedLoop& loop) {
  return loop.peak_sensitivity > kPoorSensitivity || loop.damping < kPoorDamping;
}

bool undamped(const model::ClosedLoop& loop) {
  return loop.damping < kNoDamping;
}

bool far_slower_than_possible(const model::ClosedLoop& loop, const model::ProcessFit& process) {
  return !process.integrating && loop.slowness > kSluggish;
}

bool slower_than_open_loop(const model::ClosedLoop& loop, const model::ProcessFit& process) {
  const double residence_s =
      process.time_constant_s + process.second_time_constant_s + process.delay_s;
  const double action_per_s = std::abs(process.gain * loop.integral_per_s);
  // Its inverse: integral of the error after a load by that of what the load would have come to.
  return action_per_s > 0.0 && action_per_s * kSlowerThanItself * residence_s < 1.0;
}

double memory_ratio(const model::ClosedLoop& loop, const loop::Performance& performance) {
  if (!performance.error_memory_s || loop.integral_per_s == 0.0) return 0.0;
  const double usual_s = performance.longest_delay_s + loop.integral_time_s;
  return usual_s > 0.0 ? *performance.error_memory_s / usual_s : 0.0;
}

bool at_resonance(const Evidence& evidence, const model::ClosedLoop& loop) {
  const double period_s = evidence.oscillation.period_s.value_or(0.0);
  if (!(period_s > 0.0) || !(loop.period_s > 0.0)) return false;
  return std::abs(std::log(period_s / loop.period_s)) <= std::log(kNearPeriod);
}

}  // namespace loopscope::core::diagnosis
