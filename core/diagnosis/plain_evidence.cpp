#include "core/diagnosis/plain_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string_view>

#include "core/diagnosis/effect_verdict.hpp"
#include "core/diagnosis/evidence/structure.hpp"
#include "core/diagnosis/model_words.hpp"
#include "core/diagnosis/reasons.hpp"
#include "core/diagnosis/verdicts/verdict_catalogue.hpp"
#include "core/model/effects/effect_catalogue.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::diagnosis {
namespace {

constexpr std::size_t kMostSentences = 3;

/// Whether the step is the verdict's fault, or one that the diagnosis takes for it: dead band for
/// stiction, a curved process for a curved trim. Waves, loads and tuning are told apart.
bool speaks_for(const model::Step& step, VerdictCode code) {
  const VerdictCode own = verdict_of(step);
  if (own == VerdictCode::unexplained || step.statement.empty()) return false;
  const std::string_view family = catalogue_entry(code).family;
  return own == code || verdict_of(step.effect) == code ||
         ((family == "friction" || family == "curve") && catalogue_entry(own).family == family);
}

/// The steps that speak for the verdict, those that explain most first.
std::vector<const model::Step*> speaking_steps(VerdictCode code, const model::Explanation& model) {
  std::vector<const model::Step*> steps;
  for (const model::Step& step : model.steps) {
    const bool believed = model.excited || model::is_seen_without_op(step.effect);
    if (believed && speaks_for(step, code)) steps.push_back(&step);
  }
  std::ranges::stable_sort(steps, std::ranges::greater{},
                           [](const model::Step* step) { return explained_by(*step); });
  return steps;
}

/// Of a second-order loop: one swing over the one before, on the same side.
double decay_ratio(double damping) {
  if (damping >= 1.0) return 0.0;
  return std::exp(-2.0 * std::numbers::pi * damping / std::sqrt(1.0 - damping * damping));
}

std::string tuning_text(const model::ClosedLoop& loop) {
  const std::string start = "With these settings of the controller ";
  if (!std::isfinite(loop.peak_sensitivity)) return start + "the fitted loop is unstable.";
  if (loop.period_s <= 0.0)
    return start + "a disturbance takes " + text::duration(loop.settling_s) +
           " to settle, without oscillation.";
  return start + "the loop swings with a period of " + text::duration(loop.period_s) +
         " after a disturbance, each swing " + text::percent(decay_ratio(loop.damping)) +
         " of the one before.";
}

/// Where no step says what comes from outside: that nothing within the loop does.
std::string unaccounted_text(const model::Explanation& model) {
  if (!model.excited || model.unexplained.fraction < kNearlyAll) return {};
  return "Nothing found in valve, process or sensor accounts for " +
         text::percent(model.unexplained.fraction) + " of the error that could be foreseen.";
}

std::string end_of_travel_text(const Evidence& evidence) {
  std::string at_limit = output_at_limit_text(evidence);
  if (!at_limit.empty() || !evidence.op_at_ends || evidence.op_at_ends->share <= 0.0)
    return at_limit;
  return "The controller output rests at an end of its travel in " +
         text::percent(evidence.op_at_ends->share) + " of the samples.";
}

/// Of a verdict that no step of the model speaks for.
std::string without_step(VerdictCode code, const Evidence& evidence) {
  if (code == VerdictCode::valve_saturation) return end_of_travel_text(evidence);
  if (!evidence.model) return {};
  const model::Explanation& model = *evidence.model;
  if (code == VerdictCode::external_disturbance) return unaccounted_text(model);
  if (!model.excited) return {};
  const bool tuning = catalogue_entry(code).blames == plant::Fault::tuning;
  if (tuning && model.closed_loop) return tuning_text(*model.closed_loop);
  if (code == VerdictCode::healthy && model.steps.empty() &&
      model.unexplained.fraction < kNearlyAll)
    return "A linear loop with noise explains what was recorded: no effect of valve, process or "
           "sensor is needed.";
  return {};
}

/// What the loop does that the verdict names; empty where only statistics say it. Of what comes
/// from outside, which may be several things, all that there is room for.
std::vector<std::string> behaviour(VerdictCode code, const Evidence& evidence) {
  std::vector<const model::Step*> steps;
  if (evidence.model) steps = speaking_steps(code, *evidence.model);
  if (steps.empty()) return {without_step(code, evidence)};
  const std::size_t most = code == VerdictCode::external_disturbance ? kMostSentences : 1;
  std::vector<std::string> sentences;
  for (std::size_t k = 0; k < std::min(most, steps.size()); ++k)
    sentences.push_back(steps[k]->statement);
  return sentences;
}

/// How much larger the error is than the least variance at the shortest and the longest plausible
/// delay (Harris index). Nothing of it where pv cannot be trusted, where op is at its limit, where
/// the error comes from outside, and of a level, which may be meant to move.
std::string cost(VerdictCode code, const Evidence& evidence) {
  using enum VerdictCode;
  if (code == sensor_fault || code == valve_saturation || code == external_disturbance ||
      evidence.integrating)
    return {};
  const loop::Performance& performance = evidence.performance;
  if (!performance.harris_low || !performance.harris_high) return {};
  const auto tenths = [](double harris) {
    return std::round(10.0 / std::sqrt(std::clamp(harris, 1e-4, 1.0))) / 10.0;
  };
  const double least = tenths(*performance.harris_high), most = tenths(*performance.harris_low);
  // A tenth is nothing that anybody would see on a trend.
  if (most <= 1.1) return "The error is about as small as this process and its noise allow.";
  const std::string times = least <= 1.0    ? "up to " + text::number(most)
                            : least >= most ? text::number(most)
                                            : text::number(least) + " to " + text::number(most);
  return "The error is " + times + " times the least that this process and its noise allow.";
}

/// That there is no oscillation is worth a word where one would speak against the verdict.
std::string oscillation(VerdictCode code, const Evidence& evidence) {
  if (oscillates(evidence) && evidence.oscillation.period_s)
    return "The error oscillates with a period of " +
           text::duration(*evidence.oscillation.period_s) + ".";
  const bool expected = code == VerdictCode::healthy || code == VerdictCode::sluggish_tuning;
  return expected ? "The error does not oscillate regularly." : "";
}

}  // namespace

std::vector<std::string> plain_evidence(VerdictCode code, const Evidence& evidence) {
  std::vector<std::string> sentences = behaviour(code, evidence);
  sentences.push_back(cost(code, evidence));
  // A wave from outside has been told with its own period.
  const bool told = evidence.model && code == VerdictCode::external_disturbance &&
                    !speaking_steps(code, *evidence.model).empty();
  if (!told) sentences.push_back(oscillation(code, evidence));
  std::erase(sentences, std::string());
  return sentences;
}

}  // namespace loopscope::core::diagnosis
