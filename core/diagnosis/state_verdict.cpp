#include "core/diagnosis/state_verdict.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/diagnosis/evidence/nonlinearity.hpp"
#include "core/diagnosis/odds/cause_odds.hpp"
#include "core/diagnosis/odds/log_odds.hpp"
#include "core/diagnosis/reasons.hpp"
#include "core/diagnosis/verdicts/verdict_catalogue.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::diagnosis {
namespace {

Verdict not_controlling(const Evidence& evidence) {
  Verdict verdict = verdict_with(VerdictCode::not_controlling, 1.0);
  verdict.summary = not_controlling_summary(evidence);
  verdict.action = not_controlling_action(evidence);
  return verdict;
}

/// A state that is seen raises its cause, and leaves health what is left.
void put_state(VerdictCode code, const PerCause& priors, Causes& causes) {
  const auto cause_of = [&](VerdictCode wanted) {
    const auto found = std::ranges::find(causes, wanted, &WeighedCause::code);
    if (found != causes.end()) return found;
    const double prior = priors[static_cast<std::size_t>(wanted)].value();
    return causes.insert(causes.end(), {wanted, log_odds_of(prior), prior, {}});
  };
  const auto seen = cause_of(code);
  seen->log_odds += state_evidence();
  const double most_of_health = -seen->log_odds;
  const auto health = cause_of(VerdictCode::healthy);
  health->log_odds = std::min(health->log_odds, most_of_health);
  std::ranges::stable_sort(causes, std::greater{}, &WeighedCause::log_odds);
}

/// A fault that is seen goes before causes that are weighed: a dead transmitter or an output at its
/// end is mended first, whatever else the record shows.
Verdict by_state(VerdictCode code, const Evidence& evidence, const DecisionSettings& decision) {
  Causes causes = evidence.hos ? known_causes(evidence, decision) : Causes{};
  put_state(code, priors_of(decision), causes);
  Verdict verdict = verdict_with(code, probability_in(causes, code));
  for (const WeighedCause& cause : causes) verdict.causes.push_back(report_of(cause));
  verdict.action = action_for(code, evidence, causes, decision.line);
  verdict.stands_alone = true;
  return verdict;
}

}  // namespace

Verdict verdict_of_state(LoopState state, const Evidence& evidence, const hos::Settings& settings,
                         const DecisionSettings& decision) {
  Verdict verdict = state == LoopState::not_controlling
                        ? not_controlling(evidence)
                        : by_state(state == LoopState::stands_still ? VerdictCode::sensor_fault
                                                                    : VerdictCode::valve_saturation,
                                   evidence, decision);
  if (state == LoopState::stands_still) {
    verdict.summary = frozen_summary(evidence);
    verdict.action = frozen_action() + std::string(kTuningWaits);
  }
  verdict.reasons = state_text(state, evidence);
  if (evidence.hos) {
    const std::vector<std::string> measured =
        findings(evidence, judge_nonlinearity(evidence, settings));
    verdict.reasons.insert(verdict.reasons.end(), measured.begin(), measured.end());
  }
  return verdict;
}

}  // namespace loopscope::core::diagnosis
