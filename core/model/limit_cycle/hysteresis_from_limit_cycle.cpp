#include "core/model/limit_cycle/hysteresis_from_limit_cycle.hpp"

#include <algorithm>
#include <cmath>

#include "core/model/effects/valve.hpp"
#include "core/model/limit_cycle/limit_cycle_cause.hpp"
#include "core/model/limit_cycle/slow_travel.hpp"
#include "core/signal/order/spread.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::model {
namespace {

/// The witness of the residual: one healthy loop in a hundred where there are cycles to judge, one
/// in twenty where a few strokes leave it little to see. A valve that rests over most of op's span
/// shows as a curve in op's level too.
constexpr double kCycleP = 0.01;
/// Where the one-step error shows no valve, the cycle has to show it clearly: below, more of the
/// simulated loops without a valve among their steps are healthy than stick.
constexpr double kClearScore = 0.8;
constexpr double kStrokeP = 0.05;
constexpr double kStrokeLevelP = 1e-3;
/// Whatever the witnesses say, the valve has to explain something.
constexpr double kLeastDrop = 0.95;

Step step_of(double stickband, double slip_jump, double p) {
  Step step;
  step.effect = slip_jump < ValveEffect::kPlay * stickband ? EffectKind::valve_deadband
                                                           : EffectKind::valve_stiction;
  if (step.effect == EffectKind::valve_deadband) {
    step.parameters = {{"width", "%", stickband, {}, {}}};
  } else {
    step.parameters = {{"S", "%", stickband, {}, {}}, {"J", "%", slip_jump, {}, {}}};
  }
  step.p = p;
  step.evidence = -2.0 * std::log(std::max(p, 1e-300));
  return step;
}

std::optional<Step> by_cycle(const ModelInput& input, double p) {
  const CycleCause cause = cycle_of(input);
  if (cause.decision != CycleCause::Decision::sticks || cause.score < kClearScore) {
    return std::nullopt;
  }
  const CycleEvidence& evidence = cause.evidence;
  if (driven_by_setpoint(input, evidence)) return std::nullopt;
  // Without a slip the loop would not cycle: the jump of a limit cycle is not nothing.
  Step step =
      step_of(evidence.stickband, std::max(evidence.slip_jump, 0.25 * evidence.stickband), p);
  const auto spread = signal::measure_spread(input.pv);
  const double variance = spread ? spread->std * spread->std : 0.0;
  step.law = name(ValveLaw::he);  // cycle_evidence.hpp
  step.holdout_error_before = variance * evidence.error_before;
  step.holdout_error_after = variance * std::min(evidence.error_law, evidence.error_turning);
  step.steadiness = evidence.steadiness;
  constexpr double kOddsScale = 10.0;  // what confidence_of() divides margins by
  step.margin =
      kOddsScale * std::log(std::max(cause.score, 0.01) / std::max(1.0 - cause.score, 0.01));
  step.statement = "The valve sticks. " + cause.reason;
  return step;
}

std::optional<Step> by_strokes(const ModelInput& input, double p) {
  const auto travel = judge_slow_travel(input.pv, input.op);
  if (!travel || !travel->sticks()) return std::nullopt;
  const Valve& valve = travel->valve;
  Step step = step_of(valve.stickband_percent,
                      std::max(valve.slip_jump_percent, 0.25 * valve.stickband_percent), p);
  step.law = name(kTravelLaw);
  step.holdout_error_before = travel->error_before();
  step.holdout_error_after = travel->error_after();
  step.margin = step.evidence;
  step.statement =
      "The valve stands still while the controller output travels: op alone explains " +
      text::percent(travel->linear_share) +
      " of pv's slow moves, op through a valve that sticks over " +
      text::number(valve.stickband_percent) + " % explains " + text::percent(travel->valve_share) +
      ".";
  return step;
}

}  // namespace

std::optional<Step> find_hysteresis(const ModelInput& input,
                                    const std::vector<TestOutcome>& answers, std::size_t op_turns) {
  const double p = p_of(answers, "op_direction");
  const auto lowers_the_error = [](const std::optional<Step>& step) {
    return step && step->holdout_error_after <= kLeastDrop * step->holdout_error_before;
  };
  const double level_p = p_of(answers, "op_level");
  const bool strokes_call = p <= kStrokeP || level_p <= kStrokeLevelP;
  if (op_turns <= kFewStrokes && strokes_call && input.without.keeps(Mechanism::slow_travel)) {
    auto step = by_strokes(input, std::min(p, level_p));
    if (lowers_the_error(step)) return step;
  }
  if (p > kCycleP || !input.without.keeps(Mechanism::cycle_score)) return std::nullopt;
  auto step = by_cycle(input, p);
  return lowers_the_error(step) ? step : std::nullopt;
}

bool told_by_strokes(const Step& step) {
  return step.law == name(kTravelLaw);
}

}  // namespace loopscope::core::model
