#include "core/diagnosis/leading_effect.hpp"

#include <algorithm>
#include <map>

#include "core/diagnosis/effect_verdict.hpp"

namespace loopscope::core::diagnosis {
namespace {

bool is_load_step(const model::Step& step) {
  return step.effect == model::EffectKind::load_step;
}

/// Something in the loop itself, not beside it.
bool is_inside(const model::Step& step) {
  const VerdictCode code = verdict_of(step);
  return code != verdict_of(model::EffectKind::load_step) &&
         code != verdict_of(model::EffectKind::sensor_hold) && code != VerdictCode::unexplained;
}

/// Slips that a valve's law has missed and moves that a changed gain shows in pass for load steps:
/// beside an effect inside the loop only the largest of them counts.
double explained_by_all(const model::Explanation& explanation, VerdictCode code) {
  const bool one_step = std::ranges::any_of(explanation.steps, is_inside);
  double sum = 0.0;
  double largest_step = 0.0;
  for (const model::Step& step : explanation.steps) {
    if (verdict_of(step) != code) continue;
    const double explained = model::explained_by(step);
    if (one_step && is_load_step(step))
      largest_step = std::max(largest_step, explained);
    else
      sum += explained;
  }
  return sum + largest_step;
}

}  // namespace

LeadingEffect leading_effect(const model::Explanation& explanation) {
  LeadingEffect leading;
  double most = -1.0;
  double strongest = -1.0;
  std::map<VerdictCode, double> sums;
  for (const model::Step& step : explanation.steps) {
    const VerdictCode code = verdict_of(step);
    const double sum = explained_by_all(explanation, code);
    sums[code] = sum;
    const bool takes_over = sum > most;
    if (takes_over || (code == leading.code && model::explained_by(step) > strongest)) {
      leading.code = code;
      leading.strongest = &step;
      strongest = model::explained_by(step);
      most = sum;
    }
  }
  double total = 0.0;
  for (const auto& [code, sum] : sums) total += sum;
  if (total > 0.0) leading.share = most / total;
  return leading;
}

}  // namespace loopscope::core::diagnosis
