#include "core/diagnosis/plain_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "core/diagnosis/effect_verdict.hpp"
#include "core/diagnosis/evidence/structure.hpp"
#include "core/diagnosis/verdicts/number_words.hpp"
#include "core/diagnosis/verdicts/verdict_catalogue.hpp"
#include "core/model/effects/effect_catalogue.hpp"

namespace loopscope::core::diagnosis {
namespace {

/// Of the steps that end as this verdict the one that explains most; nullptr = there is none.
const model::Step* leading_step(VerdictCode code, const model::Explanation& model) {
  const model::Step* leading = nullptr;
  for (const model::Step& step : model.steps) {
    const bool believed = model.excited || model::is_seen_without_op(step.effect);
    if (!believed || step.statement.empty() || verdict_of(step) != code) continue;
    if (leading == nullptr || explained_by(step) > explained_by(*leading)) leading = &step;
  }
  return leading;
}

std::string tuning_text(const model::ClosedLoop& loop) {
  if (!std::isfinite(loop.peak_sensitivity))
    return "With these settings of the controller the fitted loop is unstable.";
  const std::string settles = "With these settings of the controller a disturbance takes " +
                              duration(loop.settling_s) + " to settle";
  if (loop.period_s <= 0.0) return settles + ", without oscillation.";
  return settles + ", and oscillates with a period of " + duration(loop.period_s) + " meanwhile.";
}

/// What the loop does that the verdict names; empty where only statistics say it.
std::string behaviour(VerdictCode code, const Evidence& evidence) {
  if (!evidence.model) return {};
  const model::Explanation& model = *evidence.model;
  if (const model::Step* step = leading_step(code, model)) return step->statement;
  const bool tuning = catalogue_entry(code).blames == plant::Fault::tuning;
  if (tuning && model.excited && model.closed_loop) return tuning_text(*model.closed_loop);
  if (code == VerdictCode::healthy && model.excited && model.steps.empty())
    return "A linear loop with noise explains what was recorded: no effect of valve, process or "
           "sensor is needed.";
  return {};
}

/// How much larger the error is than what the best controller would leave: by the Harris index,
/// minimum over actual variance, at the shortest and the longest plausible delay.
std::string cost(const loop::Performance& performance) {
  if (!performance.harris_low || !performance.harris_high) return {};
  const auto times = [](double harris) { return 1.0 / std::sqrt(std::clamp(harris, 1e-4, 1.0)); };
  const double least = times(*performance.harris_high), most = times(*performance.harris_low);
  // Within a tenth nobody would notice the difference on a trend.
  constexpr double kAsGood = 1.1;
  if (most < kAsGood) return "The error is about as small as any controller could make it.";
  const std::string low = number(std::round(10.0 * least) / 10.0);
  const std::string high = number(std::round(10.0 * most) / 10.0);
  return "The error is " + (low == high ? low : low + " to " + high) +
         " times as large as the best controller could make it.";
}

std::string oscillation(const Evidence& evidence) {
  if (!oscillates(evidence) || !evidence.oscillation.period_s)
    return "The error does not oscillate regularly.";
  return "The error oscillates with a period of " + duration(*evidence.oscillation.period_s) + ".";
}

}  // namespace

std::vector<std::string> plain_evidence(VerdictCode code, const Evidence& evidence) {
  std::vector<std::string> sentences = {behaviour(code, evidence), cost(evidence.performance),
                                        oscillation(evidence)};
  std::erase(sentences, std::string());
  return sentences;
}

}  // namespace loopscope::core::diagnosis
