#include "core/diagnosis/stepless_verdict.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/diagnosis/effect_verdict.hpp"
#include "core/diagnosis/implied_tuning.hpp"
#include "core/diagnosis/model_confidence.hpp"
#include "core/diagnosis/model_words.hpp"
#include "core/diagnosis/words.hpp"

namespace loopscope::core::diagnosis {
namespace {

/// Times the share of op's moves that the PI law explains.
constexpr double kTuningConfidence = 0.85;
/// A loop that creeps while its implied poles ring: one of the two is wrong.
constexpr double kContradicted = 0.5;
/// An oscillation at the loop's own period although its poles are damped: noise alone drives it.
constexpr double kDampedResonance = 0.5;
/// The residual says that something is there, not what; ten of 100 loops of section 5.1 leave as
/// much, so it is no reason for a flag.
constexpr double kStructureConfidence = 0.25;
/// A healthy loop whose statistics alone were looked at has 0.6.
constexpr double kHealthyConfidence = 0.6;
constexpr double kExplainedHealth = 0.3;

struct Finding {
  const Case& loop;
  const model::Explanation& explanation;
  std::vector<std::string> reasons;

  [[nodiscard]] const Evidence& evidence() const { return loop.evidence; }
  [[nodiscard]] double held(double confidence) const {
    return held_by_structure(confidence, explanation);
  }
};

/// Advice on tuning, unless the sensor is at fault: a coarse grid makes a good loop hunt.
Verdict tuning(const Finding& finding, VerdictCode code, double confidence,
               std::optional<double> p) {
  Verdict verdict = make(code, finding.held(confidence), finding.reasons, p);
  if (has_flag(finding.evidence(), "pv_quantised")) {
    verdict.reasons.push_back(quantisation_text(finding.evidence()) +
                              " No advice on tuning while the sensor fault stands.");
    verdict.action = action_for(VerdictCode::sensor_fault) + tuning_waits();
  }
  return verdict;
}

double controller_known(const Finding& finding) {
  const double fit = finding.explanation.closed_loop->controller_fit;
  return fit > 0.0 ? std::min(fit, 1.0) : 0.0;
}

Verdict from_outside(const Finding& finding) {
  const double persistence = finding.evidence().oscillation.persistence.value_or(0.0);
  return make(VerdictCode::external_disturbance, finding.held(0.3 + 0.3 * persistence),
              finding.reasons, oscillation_p(finding.evidence()));
}

/// The period says nothing, because the controller is not known or the poles are damped: as without
/// a model, a sustained line comes from outside.
Verdict by_persistence(const Finding& finding) {
  if (sustained(finding.evidence())) return from_outside(finding);
  const double persistence = finding.evidence().oscillation.persistence.value_or(0.0);
  return tuning(finding, VerdictCode::tight_tuning, kDampedResonance * (1.0 - persistence),
                oscillation_p(finding.evidence()));
}

Verdict coupled(const Finding& finding) {
  return make(VerdictCode::nonlinear_unexplained, 0.5 * finding.loop.nonlinearity.belief,
              finding.reasons, finding.loop.nonlinearity.p);
}

Verdict oscillating(const Finding& finding) {
  const auto& closed_loop = finding.explanation.closed_loop;
  const bool own_period = closed_loop && at_resonance(finding.evidence(), *closed_loop);
  const bool line = own_period && undamped(*closed_loop) && sustained(finding.evidence());
  if (own_period && poorly_damped(*closed_loop) && !line) {
    return tuning(finding, VerdictCode::tight_tuning, kTuningConfidence * controller_known(finding),
                  oscillation_p(finding.evidence()));
  }
  if (coupling_leads(finding.loop)) return coupled(finding);
  return closed_loop && !own_period ? from_outside(finding) : by_persistence(finding);
}

bool setpoint_moves(const Evidence& evidence) {
  return has_flag(evidence, "sp_steps_masked") || has_flag(evidence, "sp_moving");
}

/// Where the setpoint moves, process and controller are known well enough to be compared, and what
/// the error does is a second witness: less is asked of it than kLongMemory.
constexpr double kLongForAWitness = 2.0;

double memory_of(const Finding& finding) {
  return memory_ratio(*finding.explanation.closed_loop, finding.evidence().performance);
}

/// At rest noise alone does not tell process from controller, and what the best controller could do
/// (Harris) is far from what a good PI controller does: how long the error remembers is what tells.
double line_at_rest(const Finding& finding) {
  const Evidence& evidence = finding.evidence();
  const bool bound_leads =
      finding.explanation.closed_loop->integral_time_s < evidence.performance.longest_delay_s;
  return bound_leads && creeps(evidence) ? kDoubtfulMemory : kLongMemory;
}

bool sluggish(const Finding& finding) {
  const model::ProcessFit& process = finding.explanation.baseline.process;
  const auto& loop = finding.explanation.closed_loop;
  if (!loop || finding.evidence().integrating) return false;
  if (!setpoint_moves(finding.evidence())) return memory_of(finding) > line_at_rest(finding);
  return far_slower_than_possible(*loop, process) && slower_than_open_loop(*loop, process) &&
         memory_of(finding) > kLongForAWitness;
}

/// Half at the line, all of it at twice the line; up to it a quarter, not enough for a flag.
double memory_known(const Finding& finding) {
  const double by_line = memory_of(finding) / kLongMemory;
  return by_line > 1.0 ? std::min(0.5 * by_line, 1.0) : 0.25;
}

double sluggish_confidence(const Finding& finding) {
  const double speed_known = setpoint_moves(finding.evidence()) ? 1.0 : memory_known(finding);
  const bool contradicted = poorly_damped(*finding.explanation.closed_loop);
  return kTuningConfidence * speed_known * controller_known(finding) *
         (contradicted ? kContradicted : 1.0);
}

Verdict healthy(Finding finding) {
  const double fraction = finding.explanation.unexplained.fraction;
  const double explained = fraction >= 0.0 ? 1.0 - std::min(fraction, 1.0) : 0.0;
  finding.reasons.emplace_back("No sustained oscillation.");
  return make(VerdictCode::healthy, kHealthyConfidence + kExplainedHealth * explained,
              std::move(finding.reasons));
}

Verdict quiet(const Finding& finding) {
  const Evidence& evidence = finding.evidence();
  if (has_flag(evidence, "pv_quantised")) {
    return make(VerdictCode::sensor_fault, kGridConfidence,
                with(finding.reasons, quantisation_text(evidence)));
  }
  if (sluggish(finding)) {
    return tuning(finding, VerdictCode::sluggish_tuning, sluggish_confidence(finding),
                  evidence.performance.harris_p.value_or(1.0));
  }
  if (finding.loop.nonlinearity.found) return coupled(finding);
  if (leaves_structure(finding.explanation)) {
    return make(VerdictCode::unexplained, kStructureConfidence, finding.reasons,
                structure_p(finding.explanation));
  }
  return healthy(finding);
}

std::vector<std::string> reasons_with(const Case& loop, const BelievedExplanation& story) {
  std::vector<std::string> reasons = story.doubts;
  reasons.push_back("The linear model needs no effect. " + unexplained_text(story.explanation));
  if (story.explanation.closed_loop) {
    reasons.push_back(closed_loop_text(*story.explanation.closed_loop));
  }
  const std::vector<std::string> measured = reasons_of(loop);
  reasons.insert(reasons.end(), measured.begin(), measured.end());
  if (middle_harris(loop.evidence)) reasons.push_back(harris_text(loop.evidence));
  return reasons;
}

}  // namespace

Verdict stepless_verdict(const Case& loop, const BelievedExplanation& story) {
  const Finding finding{loop, story.explanation, reasons_with(loop, story)};
  if (oversized(loop.evidence) && (oscillates(loop.evidence) || loop.nonlinearity.found)) {
    return oversized_valve(loop, coupling_or_oscillation_p(loop));
  }
  return oscillates(loop.evidence) ? oscillating(finding) : quiet(finding);
}

}  // namespace loopscope::core::diagnosis
