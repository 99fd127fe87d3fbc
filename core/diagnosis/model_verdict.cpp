#include "core/diagnosis/model_verdict.hpp"

#include <algorithm>
#include <utility>

#include "core/diagnosis/contradiction.hpp"
#include "core/diagnosis/disturbance_words.hpp"
#include "core/diagnosis/effect_verdict.hpp"
#include "core/diagnosis/implied_tuning.hpp"
#include "core/diagnosis/leading_effect.hpp"
#include "core/diagnosis/model_confidence.hpp"
#include "core/diagnosis/model_words.hpp"
#include "core/diagnosis/stepless_verdict.hpp"
#include "core/diagnosis/words.hpp"

namespace loopscope::core::diagnosis {
namespace {

/// A limit cycle of a valve too large for its process: what sticks or has play, it is the size that
/// makes a fraction of a percent matter.
bool is_oversized(const Case& loop, VerdictCode leading) {
  return oversized(loop.evidence) &&
         (leading == VerdictCode::valve_stiction || leading == VerdictCode::valve_deadband ||
          leading == VerdictCode::valve_characteristic ||
          leading == VerdictCode::process_nonlinearity);
}

/// The coarse grid of a sensor is seen, not inferred from an error that it need not lower.
bool is_grid_fact(const Case& loop, const LeadingEffect& leading) {
  return leading.strongest->effect == model::EffectKind::sensor_quantisation &&
         has_flag(loop.evidence, "pv_quantised");
}

double confidence_with(const Case& loop, const model::Explanation& explanation,
                       const LeadingEffect& leading) {
  const double missing = loop.evidence.data_quality.missing_fraction.value_or(0.0);
  const double confidence = confidence_of(explanation) * (1.0 - std::clamp(missing, 0.0, 1.0));
  return is_grid_fact(loop, leading) ? std::max(confidence, kGridConfidence) : confidence;
}

/// That something is there is one claim, that it is nonlinear another.
double held_by_coupling(const Case& loop, VerdictCode code, double confidence) {
  if (code != VerdictCode::nonlinear_unexplained) return confidence;
  return std::min(confidence, 0.5 + 0.5 * loop.nonlinearity.belief);
}

std::optional<double> p_with(const Case& loop, const LeadingEffect& leading, VerdictCode code) {
  if (code == VerdictCode::nonlinear_unexplained) return loop.nonlinearity.p;
  if (is_grid_fact(loop, leading)) return std::nullopt;
  return measured_p(*leading.strongest);
}

/// Shapes that accuse the valve while the model finds an oscillation from outside.
bool shapes_overruled(const Case& loop, VerdictCode leading) {
  return leading == VerdictCode::external_disturbance && !loop.valve.measured &&
         loop.valve.kind == ValvePattern::Kind::sticks;
}

bool withholds(const model::Explanation& explanation) {
  return std::ranges::any_of(explanation.steps, [](const model::Step& step) {
    return withholds_tuning(verdict_of(step));
  });
}

/// A fault in front of the controller makes a good tuning look bad.
std::string withheld_text(const model::Explanation& explanation) {
  const auto& closed_loop = explanation.closed_loop;
  if (!closed_loop || !withholds(explanation) || !poorly_damped(*closed_loop)) return {};
  return closed_loop_text(*closed_loop) +
         " No advice on tuning while the valve or sensor fault stands.";
}

std::vector<std::string> reasons_with(const Case& loop, const BelievedExplanation& story,
                                      VerdictCode leading) {
  std::vector<std::string> reasons;
  for (const model::Step& step : story.explanation.steps) reasons.push_back(step_text(step));
  reasons.push_back(unexplained_text(story.explanation));
  reasons.insert(reasons.end(), story.doubts.begin(), story.doubts.end());
  if (shapes_overruled(loop, leading)) {
    reasons.emplace_back(
        "Shapes and cross-correlation look like stiction, as those of an outside sinusoid may; the "
        "model overrules them.");
  }
  if (std::string withheld = withheld_text(story.explanation); !withheld.empty()) {
    reasons.push_back(std::move(withheld));
  }
  const std::vector<std::string> measured = reasons_of(loop);
  reasons.insert(reasons.end(), measured.begin(), measured.end());
  return reasons;
}

/// What leads without a name is nonlinear where the statistics say so.
VerdictCode code_of(const Case& loop, const LeadingEffect& leading) {
  if (is_oversized(loop, leading.code)) return VerdictCode::valve_oversized;
  return leading.code == VerdictCode::unexplained && loop.nonlinearity.found
             ? VerdictCode::nonlinear_unexplained
             : leading.code;
}

/// A wave has another action than a load that moves.
void tell_disturbance(const model::Explanation& explanation, Verdict& verdict) {
  const DisturbanceWords words = words_of(disturbance_of(explanation), explanation);
  verdict.summary = words.summary;
  verdict.action = words.action;
}

Verdict of_leading(const Case& loop, const BelievedExplanation& story) {
  const LeadingEffect leading = leading_effect(story.explanation);
  std::vector<std::string> reasons = reasons_with(loop, story, leading.code);
  const VerdictCode code = code_of(loop, leading);
  if (code == VerdictCode::valve_oversized)
    reasons.push_back(oversized_text(loop.evidence.valve_gain));
  Verdict verdict =
      make(code, held_by_coupling(loop, code, confidence_with(loop, story.explanation, leading)),
           std::move(reasons), p_with(loop, leading, code));
  if (code == VerdictCode::external_disturbance) tell_disturbance(story.explanation, verdict);
  // The words for saturation say so already.
  const bool said = verdict.code == VerdictCode::valve_saturation;
  if (withholds_tuning(verdict.code) && !said) verdict.action += tuning_waits();
  return verdict;
}

BelievedExplanation from_outside(const Case& loop) {
  BelievedExplanation story{*loop.evidence.model, {}};
  const auto inside = [](const model::Step& step) {
    return !model::is_from_outside(step.effect);
  };
  for (const model::Step& step : story.explanation.steps) {
    if (inside(step))
      story.doubts.push_back("The model took in " + std::string(model::name(step.effect)) +
                             ", but op moves too little to show it: not believed.");
  }
  std::erase_if(story.explanation.steps, inside);
  return story;
}

}  // namespace

std::optional<Verdict> outside_verdict(const Case& loop) {
  const BelievedExplanation story = from_outside(loop);
  if (story.explanation.steps.empty()) return std::nullopt;
  return of_leading(loop, story);
}

Verdict model_verdict(const Case& loop) {
  const BelievedExplanation story = believed(loop);
  return story.explanation.steps.empty() ? stepless_verdict(loop, story) : of_leading(loop, story);
}

}  // namespace loopscope::core::diagnosis
