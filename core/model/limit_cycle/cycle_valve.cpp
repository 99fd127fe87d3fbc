#include "core/model/limit_cycle/cycle_valve.hpp"

#include <algorithm>
#include <cmath>

#include "core/model/effects/effect_catalogue.hpp"
#include "core/model/limit_cycle/limit_cycle_cause.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::model {
namespace {

/// Logistic regression on the families of simulated recordings that the score was fitted on,
/// rounded. The score's own log odds count half: both witnesses see the same cycle.
constexpr double kShapeWeight = 0.5;
constexpr double kBandWeight = 5.5;
constexpr double kPriorLogOdds = -2.3;
/// A band of op's whole travel leaves nothing to add.
constexpr double kWidestShare = 1.0;
/// Noise turns op too, and its turns line up with themselves to about a half.
constexpr double kMoreThanNoise = 0.6;
/// Limit cycles mostly repeat themselves to so much and more.
constexpr double kRepeats = 0.75;
/// So do moves of the setpoint across play: to 0.48 to 0.87, three in four below 0.73, in 30 loops.
constexpr double kRepeatsUnderMoves = 0.8;
/// The one-step error alone has found a slip: the cycle has to speak clearly against it.
constexpr double kThreeToOneAgainst = -1.1;

double log_odds(double probability) {
  constexpr double kLeast = 1e-4;
  const double p = std::clamp(probability, kLeast, 1.0 - kLeast);
  return std::log(p / (1.0 - p));
}

/// op repeats its half cycle more clearly than what else moves it would let it.
bool cycles_by_itself(const CycleEvidence& cycle, const ModelInput& input) {
  if (!setpoint_moves(input)) return cycle.op_coherence >= kMoreThanNoise;
  return cycle.op_coherence >= kRepeatsUnderMoves && !driven_by_setpoint(input, cycle);
}

/// Its first parameter is the band.
bool has_band(const Step& step) {
  return is_valve_hysteresis(step.effect) && !step.parameters.empty();
}

void mark_as_stuck(Step& step, const CycleEvidence& cycle) {
  step.cycle_indicates_stiction = true;
  step.statement +=
      " The loop keeps cycling across it, as a loop with a sticking valve does: the band is " +
      text::percent(step.parameters.front().value / cycle.travel) +
      " of the controller output's travel, and the output repeats its half cycle to " +
      text::percent(cycle.op_coherence) + ".";
}

}  // namespace

bool follows_in_cycle(const CycleEvidence& cycle) {
  constexpr double kHalfway = 0.5;
  return cycle.process_lag() < kHalfway;
}

double odds_that_valve_cycles(const CycleCause& cause, double band_percent) {
  if (!(cause.evidence.travel > 0.0)) return kPriorLogOdds;
  const double share = std::min(band_percent / cause.evidence.travel, kWidestShare);
  return kShapeWeight * log_odds(cause.score) + kBandWeight * share + kPriorLogOdds;
}

void weigh_valves_by_cycle(const ModelInput& input, std::vector<Step>& steps) {
  if (!input.without.keeps(Mechanism::cycle_score) || std::ranges::none_of(steps, has_band)) return;
  const CycleCause cause = cycle_of(input);
  if (cause.decision == CycleCause::Decision::undecided) return;
  const bool cycles = cycles_by_itself(cause.evidence, input);
  const bool steadily = cause.evidence.op_coherence >= kRepeats && !setpoint_moves(input);
  for (Step& step : steps) {
    if (!has_band(step)) continue;
    const double odds = odds_that_valve_cycles(cause, step.parameters.front().value);
    const bool play = step.effect == EffectKind::valve_deadband;
    if (play && odds > 0.0 && cycles && follows_in_cycle(cause.evidence))
      mark_as_stuck(step, cause.evidence);
    step.cycle_contradicts_valve = !play && odds < kThreeToOneAgainst && steadily;
  }
}

}  // namespace loopscope::core::model
