#include "core/diagnosis/decide.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "core/diagnosis/disturbance_words.hpp"
#include "core/diagnosis/evidence/nonlinearity.hpp"
#include "core/diagnosis/evidence/structure.hpp"
#include "core/diagnosis/loop_state.hpp"
#include "core/diagnosis/odds/log_odds.hpp"
#include "core/diagnosis/plain_evidence.hpp"
#include "core/diagnosis/reasons.hpp"
#include "core/diagnosis/state_verdict.hpp"
#include "core/diagnosis/unit_words.hpp"
#include "core/diagnosis/valve_words.hpp"
#include "core/diagnosis/verdict_p.hpp"
#include "core/diagnosis/verdicts/verdict_catalogue.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::diagnosis {
namespace {

/// Nonlinear or not is a question with two answers, and the likelier one is said; of a dozen causes
/// one may be named sooner.
constexpr double kLikelier = 0.5;

bool may_be_named(const WeighedCause& cause, const Circumstances& circumstances) {
  if (cause.code == VerdictCode::healthy || cause.code == VerdictCode::nonlinear_unexplained)
    return false;
  if (cause.code == VerdictCode::valve_saturation) return circumstances.limit_seen;
  return cause.code != VerdictCode::valve_oversized || circumstances.sizes_known;
}

/// op at a limit of its range, at rest at an end of its travel, or held there by the model.
bool sees_limit(const Evidence& evidence) {
  if (evidence.data_quality.saturated_fraction.value_or(0.0) > 0.0) return true;
  if (evidence.op_at_ends && evidence.op_at_ends->share > 0.0) return true;
  return evidence.model && std::ranges::any_of(evidence.model->steps, [](const model::Step& step) {
           return step.effect == model::EffectKind::valve_saturation;
         });
}

Circumstances circumstances_of(const Evidence& evidence, double alpha) {
  return {is_structured(evidence),
          evidence.op_range_set && evidence.valve_gain.pv_span_percent.has_value(),
          sees_limit(evidence), shows_nonlinearity(evidence, alpha)};
}

double confidence_in(VerdictCode code, const Causes& causes) {
  if (code != VerdictCode::unexplained) return probability_in(causes, code);
  double largest = 0.0;
  for (const WeighedCause& cause : causes) largest = std::max(largest, cause.probability());
  return 1.0 - largest;
}

/// No cause: certain, and outside of what is weighed.
Verdict insufficient(const Evidence& evidence) {
  Verdict verdict = verdict_with(VerdictCode::insufficient_data, 1.0);
  verdict.reasons = {text::as_sentence(evidence.data_quality.reason)};
  return verdict;
}

/// A wave has another action than a load that moves.
void tell_disturbance(const Evidence& evidence, Verdict& verdict) {
  const model::Explanation model = evidence.model.value_or(model::Explanation{});
  Disturbance disturbance = disturbance_of(model);
  if (disturbance == Disturbance::none && oscillates(evidence)) disturbance = Disturbance::wave;
  if (disturbance == Disturbance::none) return;
  DisturbanceWords words = words_of(disturbance, model);
  verdict.summary = std::move(words.summary);
  verdict.action = std::move(words.action);
}

void append(std::vector<std::string>&& more, std::vector<std::string>& reasons) {
  for (std::string& reason : more) reasons.push_back(std::move(reason));
}

/// A state, seen in the data: no cause is weighed.
Verdict not_in_command(const Evidence& evidence, const NonlinearityFinding& nonlinearity) {
  Verdict verdict = verdict_with(VerdictCode::unexplained, 1.0);
  verdict.summary = "The controller is not in command, or has no integral action.";
  const std::string units = unit_reason(evidence);
  verdict.reasons.emplace_back(
      "pv stays many standard deviations away from its setpoint: the controller is not in command, "
      "or has no integral action.");
  if (!units.empty()) verdict.reasons.push_back(units);
  append(findings(evidence, nonlinearity), verdict.reasons);
  verdict.action =
      std::string(units.empty() ? "Check" : "Compare the units of setpoint and pv; then check") +
      " whether an override or another controller holds the valve; if that is meant, disable the "
      "loop in the catalogue.";
  return verdict;
}

/// A state as well: an error between two units is none.
Verdict in_other_units(const Evidence& evidence, const NonlinearityFinding& nonlinearity) {
  Verdict verdict = verdict_with(VerdictCode::unexplained, evidence.units->probability);
  verdict.summary = unit_summary();
  verdict.reasons.push_back(unit_reason(evidence));
  append(findings(evidence, nonlinearity), verdict.reasons);
  verdict.action = unit_action();
  return verdict;
}

/// Even for the most favourable delay less than a third of what the best controller leaves.
constexpr double kSlowHarris = 0.3;

/// Nothing is broken where a loop corrects more slowly than it could, but "nothing to do" says too
/// much.
void note_slowness(const Evidence& evidence, const Causes& causes, Verdict& verdict) {
  const std::optional<double> low = evidence.performance.harris_low;
  const std::optional<double> high = evidence.performance.harris_high;
  if (verdict.code != VerdictCode::healthy || evidence.integrating || !low || !high ||
      *high >= kSlowHarris)
    return;
  verdict.summary = "No fault is probable, but the loop corrects slowly: Harris index " +
                    text::number(*low) + " to " + text::number(*high) + ".";
  verdict.action =
      "Nothing has to be repaired. Where the error matters, raise the controller gain or speed up "
      "the integral action in small steps (sluggish tuning is " +
      text::percent(probability_in(causes, VerdictCode::sluggish_tuning)) + " probable).";
}

/// The log odds of this window give way to those of all.
void put_combined(const CombinedOdds& combined, const PerCause& priors, Causes& causes) {
  const PerCause probabilities = probabilities_of(combined, priors);
  for (WeighedCause& cause : causes) {
    const auto place = static_cast<std::size_t>(cause.code);
    if (place < probabilities.size() && probabilities[place])
      cause.log_odds = log_odds_of(*probabilities[place]);
  }
  std::ranges::stable_sort(causes, std::greater{}, &WeighedCause::log_odds);
}

std::string windows_text(double alone) {
  return "Judged by several windows together; by the newest alone this finding would be " +
         text::percent(alone) + " probable.";
}

Verdict by_odds(const Evidence& evidence, const NonlinearityFinding& nonlinearity, double alpha,
                const DecisionSettings& decision, const CombinedOdds* combined) {
  Causes causes = known_causes(evidence, decision);
  const Causes alone = causes;
  if (combined) put_combined(*combined, priors_of(decision), causes);
  const VerdictCode code = code_for(causes, circumstances_of(evidence, alpha), decision.line);
  Verdict verdict = verdict_with(code, confidence_in(code, causes));
  for (const WeighedCause& cause : causes) verdict.causes.push_back(report_of(cause));
  const auto own = std::ranges::find(verdict.causes, code, &CauseReport::code);
  verdict.reasons = own == verdict.causes.end() ? findings(evidence, nonlinearity)
                                                : reasons_for(*own, evidence, nonlinearity);
  if (combined)
    verdict.reasons.insert(verdict.reasons.begin(), windows_text(confidence_in(code, alone)));
  std::vector<std::string> plain = plain_evidence(code, evidence);
  if (std::string why = why_stiction(code, evidence, alone, decision.line); !why.empty())
    plain.insert(plain.begin() + (plain.empty() ? 0 : 1), std::move(why));
  if (!plain.empty()) plain.emplace_back(kFiguresFollow);
  verdict.reasons.insert(verdict.reasons.begin(), plain.begin(), plain.end());
  verdict.action = action_for(code, evidence, causes, decision.line);
  if (std::string summary = valve_summary(code, evidence); !summary.empty())
    verdict.summary = std::move(summary);
  verdict.p = p_of_verdict(code, evidence);
  note_slowness(evidence, causes, verdict);
  if (code == VerdictCode::external_disturbance) tell_disturbance(evidence, verdict);
  return verdict;
}

void note_window(const Evidence& evidence, Verdict& verdict) {
  if (has_flag(evidence, "short"))
    verdict.reasons.emplace_back("Short record: fewer than 32 segments.");
  if (!evidence.data_quality.stretch.empty()) {
    verdict.reasons.push_back("The loop changed within the window: the tests use only " +
                              evidence.data_quality.stretch + ".");
  }
}

Verdict said_of(const Evidence& evidence, const hos::Settings& settings,
                const DecisionSettings& decision, const CombinedOdds* combined) {
  if (const LoopState state = state_of(evidence); state != LoopState::none)
    return verdict_of_state(state, evidence, settings, decision);
  if (!evidence.data_quality.usable || !evidence.hos) return insufficient(evidence);
  const NonlinearityFinding nonlinearity = judge_nonlinearity(evidence, settings);
  Verdict verdict = unit_finding(evidence) == UnitFinding::shown
                        ? in_other_units(evidence, nonlinearity)
                    : has_flag(evidence, "sp_not_followed")
                        ? not_in_command(evidence, nonlinearity)
                        : by_odds(evidence, nonlinearity, settings.alpha, decision, combined);
  note_window(evidence, verdict);
  return verdict;
}

}  // namespace

VerdictCode code_for(const Causes& causes, const Circumstances& circumstances, double line) {
  const auto named = std::ranges::find_if(
      causes, [&](const WeighedCause& cause) { return may_be_named(cause, circumstances); });
  const double health = probability_in(causes, VerdictCode::healthy);
  const double least = std::max(line, health);
  if (named != causes.end() && named->probability() >= least) return named->code;
  if (circumstances.nonlinear_shown &&
      probability_in(causes, VerdictCode::nonlinear_unexplained) >= std::max(least, kLikelier))
    return VerdictCode::nonlinear_unexplained;
  const bool unclear = health < line && circumstances.structured;
  return unclear ? VerdictCode::unexplained : VerdictCode::healthy;
}

Verdict decide(const Evidence& evidence, const hos::Settings& settings,
               const DecisionSettings& decision, const CombinedOdds* combined) {
  Verdict verdict = said_of(evidence, settings, decision, combined);
  verdict.priors = priors_of(decision);
  return verdict;
}

}  // namespace loopscope::core::diagnosis
