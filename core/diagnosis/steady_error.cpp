#include "core/diagnosis/steady_error.hpp"

#include <algorithm>
#include <limits>
#include <string_view>
#include <utility>

#include "core/hos/linear/draw_missing.hpp"
#include "core/hos/linear/stationary_stretch.hpp"
#include "core/hos/transforms/segments.hpp"
#include "core/loop/setpoint_response.hpp"
#include "core/signal/setpoint_steps.hpp"

namespace loopscope::core {
namespace {

SteadyError of(signal::Samples error, const char* flag) {
  SteadyError steady;
  steady.error = std::move(error);
  steady.flag = flag;
  return steady;
}

SteadyError without_steps(const signal::PreparedLoop& loop, const hos::Settings& settings) {
  signal::ErrorBetweenSteps between = signal::error_between_steps(loop);
  if (between.steps == 0) return of(std::move(between.error), nullptr);
  const bool enough = hos::segment_starts(between.error, settings).size() >= kMinSegments;
  if (enough && between.masked_fraction > 0.0) {
    return of(std::move(between.error), "sp_steps_masked");
  }
  SteadyError moving =
      of(loop.drawable.error.empty() ? loop.error : loop.drawable.error, "sp_moving");
  moving.residual = loop::without_setpoint_response(moving.error, loop.sp);
  return moving;
}

std::string words(const hos::Stretch& stretch, std::size_t samples) {
  return "samples " + std::to_string(stretch.first + 1) + " to " +
         std::to_string(stretch.first + stretch.size) + " of " + std::to_string(samples);
}

/// Masks what is outside; an error value like any other that is missing.
signal::Samples within(const hos::Stretch& stretch, signal::Samples error) {
  constexpr double kMasked = std::numeric_limits<double>::quiet_NaN();
  const auto first = error.begin() + static_cast<std::ptrdiff_t>(stretch.first);
  std::fill(error.begin(), first, kMasked);
  std::fill(first + static_cast<std::ptrdiff_t>(stretch.size), error.end(), kMasked);
  return error;
}

/// A setpoint that never rests makes any error non-Gaussian.
void refuse_unanswered(SteadyError& steady) {
  const bool moving = steady.flag != nullptr && std::string_view(steady.flag) == "sp_moving";
  if (!moving || !steady.residual.empty() || !steady.refusal.empty()) return;
  steady.refusal =
      "the setpoint moves too often to be left out, and no linear answer to it is found";
}

void keep_stationary(const hos::Settings& settings, SteadyError& steady) {
  const hos::Stretch stretch = hos::stationary_stretch(steady.tested());
  if (stretch.size == steady.error.size()) return;
  steady.stationary = false;
  signal::Samples kept = within(stretch, steady.error);
  if (hos::segment_starts(kept, settings).size() < kMinSegments) {
    steady.refusal = "the loop changes too often: no stationary stretch is long enough";
    return;
  }
  steady.stretch = words(stretch, steady.error.size());
  steady.error = std::move(kept);
  if (!steady.residual.empty()) steady.residual = within(stretch, std::move(steady.residual));
}

}  // namespace

SteadyError steady_error(const signal::PreparedLoop& loop, const hos::Settings& settings,
                         std::uint64_t seed) {
  SteadyError steady = without_steps(loop, settings);
  if (!loop.drawable.low.empty()) {
    steady.error = hos::draw_missing(steady.error, {loop.drawable.low, loop.drawable.high}, seed);
    if (!steady.residual.empty())
      steady.residual = loop::without_setpoint_response(steady.error, loop.sp);
  }
  keep_stationary(settings, steady);
  refuse_unanswered(steady);
  return steady;
}

}  // namespace loopscope::core
