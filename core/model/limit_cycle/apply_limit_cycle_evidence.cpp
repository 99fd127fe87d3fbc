#include "core/model/limit_cycle/apply_limit_cycle_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/model/effects/effect_catalogue.hpp"
#include "core/model/limit_cycle/cycle_valve.hpp"
#include "core/model/limit_cycle/hysteresis_from_limit_cycle.hpp"
#include "core/model/residual_tests/run_residual_tests.hpp"

namespace loopscope::core::model {
namespace {

/// What slips of a valve pass for, one by one.
bool jumps(const Step& step) {
  return step.effect == EffectKind::load_step;
}

bool has_hysteresis(const Step& step) {
  return is_valve_hysteresis(step.effect);
}

bool is_outside_cycle(const Step& step) {
  return step.effect == EffectKind::external_oscillation;
}

double explained(const std::vector<Step>& steps, bool (*counts)(const Step&)) {
  double sum = 0.0;
  for (const Step& step : steps) {
    if (counts(step)) sum += explained_by(step);
  }
  return sum;
}

/// A law was found for a few of the valve's slips, and the others passed for jumps: as many as a
/// model takes in, which explain more than the law does, and nothing else but what they leave of
/// a gain that seems to change.
bool most_slips_pass_for_jumps(const std::vector<Step>& steps) {
  constexpr std::ptrdiff_t kMostSlips = 3;
  const auto belongs = [](const Step& step) {
    return has_hysteresis(step) || jumps(step) || step.effect == EffectKind::gain_change;
  };
  return std::ranges::count_if(steps, jumps) >= kMostSlips && std::ranges::all_of(steps, belongs) &&
         explained(steps, jumps) > explained(steps, has_hysteresis);
}

/// Nine to one, in the units of `margin`.
constexpr double kClear = 22.0;

/// Whether the effects that were selected speak against the valve that the three witnesses see.
bool others_stand(const std::vector<Step>& steps, const std::vector<TestOutcome>& left,
                  const Step& valve) {
  constexpr double kStillThere = 0.05;
  if (valve.margin >= kClear || std::ranges::all_of(steps, jumps)) return false;
  return std::ranges::any_of(steps, is_outside_cycle) || p_of(left, "op_direction") > kStillThere;
}

}  // namespace

void apply_limit_cycle_evidence(const ModelInput& input, const std::vector<TestOutcome>& first,
                                const std::vector<TestOutcome>& left, std::size_t op_turns,
                                Explanation& explanation) {
  const bool few_strokes = op_turns <= kFewStrokes;
  const bool named = !few_strokes && std::ranges::any_of(explanation.steps, has_hysteresis);
  std::optional<Step> step;
  if (!named || most_slips_pass_for_jumps(explanation.steps))
    step = find_hysteresis(input, first, op_turns);
  if (named && !(step && step->margin >= kClear))
    return weigh_valves_by_cycle(input, explanation.steps);
  if (!step) return;
  if (!few_strokes && others_stand(explanation.steps, left, *step)) return;
  explanation.error_kind = ErrorKind::simulation;
  explanation.excited = true;
  explanation.baseline.holdout_error = step->holdout_error_before;
  // What a perfect model would leave of pv in the band of the cycle is not known: what the valve
  // leaves of the linear error is an upper bound of what is unexplained.
  explanation.noise_floor = std::nan("");
  explanation.unexplained.fraction =
      std::clamp(step->holdout_error_after / step->holdout_error_before, 0.0, 1.0);
  step->asked_by = asked_by(step->effect, first, {});  // not asked again: no one-step model has it
  step->promise_rank = Nominations(first).rank(step->effect);
  explanation.steps = {std::move(*step)};
}

}  // namespace loopscope::core::model
