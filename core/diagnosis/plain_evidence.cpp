#include "core/diagnosis/plain_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string_view>

#include "core/diagnosis/effect_verdict.hpp"
#include "core/diagnosis/evidence/structure.hpp"
#include "core/diagnosis/verdicts/number_words.hpp"
#include "core/diagnosis/verdicts/verdict_catalogue.hpp"
#include "core/model/effects/effect_catalogue.hpp"

namespace loopscope::core::diagnosis {
namespace {

/// Whether the step is the verdict's fault, or one that the diagnosis takes for it: dead band for
/// stiction, a curved process for a curved trim. Waves, loads and tuning are told apart.
bool speaks_for(const model::Step& step, VerdictCode code) {
  const VerdictCode own = verdict_of(step);
  if (own == VerdictCode::unexplained || step.statement.empty()) return false;
  const std::string_view family = catalogue_entry(code).family;
  return own == code || verdict_of(step.effect) == code ||
         ((family == "friction" || family == "curve") && catalogue_entry(own).family == family);
}

/// What the step says that explains most of those that speak for the verdict. Of several things
/// from outside none is told alone: the summary tells them together.
std::string step_words(VerdictCode code, const model::Explanation& model) {
  const model::Step* leading = nullptr;
  std::size_t count = 0;
  for (const model::Step& step : model.steps) {
    const bool believed = model.excited || model::is_seen_without_op(step.effect);
    if (!believed || !speaks_for(step, code)) continue;
    ++count;
    if (leading == nullptr || explained_by(step) > explained_by(*leading)) leading = &step;
  }
  if (leading == nullptr) return {};
  return code == VerdictCode::external_disturbance && count > 1 ? std::string()
                                                                : leading->statement;
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
    return start + "a disturbance takes " + duration(loop.settling_s) +
           " to settle, without oscillation.";
  return start + "the loop swings with a period of " + duration(loop.period_s) +
         " after a disturbance, each swing " + percent(decay_ratio(loop.damping)) +
         " of the one before.";
}

/// A linear loop that leaves less than this of what could be explained is enough.
constexpr double kNearlyAll = 0.1;

/// What the loop does that the verdict names; empty where only statistics say it.
std::string behaviour(VerdictCode code, const Evidence& evidence) {
  if (!evidence.model) return {};
  const model::Explanation& model = *evidence.model;
  if (std::string words = step_words(code, model); !words.empty()) return words;
  const bool tuning = catalogue_entry(code).blames == plant::Fault::tuning;
  if (tuning && model.excited && model.closed_loop) return tuning_text(*model.closed_loop);
  if (code == VerdictCode::healthy && model.excited && model.steps.empty() &&
      model.unexplained.fraction < kNearlyAll)
    return "A linear loop with noise explains what was recorded: no effect of valve, process or "
           "sensor is needed.";
  return {};
}

/// Whether a better controller could make the error smaller: not behind a valve at its limit, and
/// what comes from outside is stopped there first. A level may be meant to move.
bool controller_could_help(VerdictCode code, const Evidence& evidence) {
  return code != VerdictCode::valve_saturation && code != VerdictCode::external_disturbance &&
         !evidence.integrating;
}

/// How much larger the error is than what the best controller would leave: by the Harris index,
/// minimum over actual variance, at the shortest and the longest plausible delay.
std::string cost(const loop::Performance& performance) {
  if (!performance.harris_low || !performance.harris_high) return {};
  const auto tenths = [](double harris) {
    return std::round(10.0 / std::sqrt(std::clamp(harris, 1e-4, 1.0))) / 10.0;
  };
  const double least = tenths(*performance.harris_high), most = tenths(*performance.harris_low);
  // A tenth is nothing that anybody would see on a trend.
  if (most <= 1.1) return "The error is about as small as any controller could make it.";
  const std::string times = least <= 1.0    ? "up to " + number(most)
                            : least >= most ? number(most)
                                            : number(least) + " to " + number(most);
  return "The error is " + times + " times as large as the best controller could make it.";
}

/// That there is no oscillation is worth a word where one would speak against the verdict.
std::string oscillation(VerdictCode code, const Evidence& evidence) {
  if (oscillates(evidence) && evidence.oscillation.period_s)
    return "The error oscillates with a period of " + duration(*evidence.oscillation.period_s) +
           ".";
  const bool expected = code == VerdictCode::healthy || code == VerdictCode::sluggish_tuning;
  return expected ? "The error does not oscillate regularly." : "";
}

}  // namespace

std::vector<std::string> plain_evidence(VerdictCode code, const Evidence& evidence) {
  std::vector<std::string> sentences{behaviour(code, evidence)};
  if (controller_could_help(code, evidence)) sentences.push_back(cost(evidence.performance));
  // A wave from outside has been told with its own period.
  const bool told = code == VerdictCode::external_disturbance && !sentences.front().empty();
  if (!told) sentences.push_back(oscillation(code, evidence));
  std::erase(sentences, std::string());
  return sentences;
}

}  // namespace loopscope::core::diagnosis
