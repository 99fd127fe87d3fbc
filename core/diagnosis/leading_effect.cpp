#include "core/diagnosis/leading_effect.hpp"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/effect_verdict.hpp"

namespace loopscope::core::diagnosis {
namespace {

double explained_by_all(const model::Explanation& explanation, VerdictCode code) {
  double sum = 0.0;
  for (const model::Step& step : explanation.steps) {
    if (verdict_of(step.effect) == code) sum += explained_by(step);
  }
  return sum;
}

}  // namespace

double explained_by(const model::Step& step) {
  const double drop = std::log(step.holdout_error_before / step.holdout_error_after);
  return std::isfinite(drop) ? std::max(drop, 0.0) : 0.0;
}

LeadingEffect leading_effect(const model::Explanation& explanation) {
  LeadingEffect leading;
  double most = -1.0;
  double strongest = -1.0;
  double total = 0.0;
  for (const model::Step& step : explanation.steps) {
    const VerdictCode code = verdict_of(step.effect);
    const double sum = explained_by_all(explanation, code);
    const bool takes_over = sum > most;
    if (takes_over || (code == leading.code && explained_by(step) > strongest)) {
      leading.code = code;
      leading.strongest = &step;
      strongest = explained_by(step);
      most = sum;
    }
    total += explained_by(step);
  }
  if (total > 0.0) leading.share = most / total;
  return leading;
}

}  // namespace loopscope::core::diagnosis
