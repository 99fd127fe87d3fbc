#include "core/diagnosis/valve_words.hpp"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/verdicts/verdict_catalogue.hpp"
#include "core/model/effects/effect_catalogue.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::diagnosis {
namespace {

/// An output is hardly stepped by less, %.
constexpr double kLeastStep = 0.1;

/// The step that found friction or dead band and explains most; nullptr where there is none.
const model::Step* band_step(const Evidence& evidence) {
  if (!evidence.model || !evidence.model->excited) return nullptr;
  const model::Step* most = nullptr;
  for (const model::Step& step : evidence.model->steps) {
    const bool band = step.effect == model::EffectKind::valve_stiction ||
                      step.effect == model::EffectKind::valve_deadband;
    if (!band || step.parameters.empty()) continue;
    if (most == nullptr || model::explained_by(step) > model::explained_by(*most)) most = &step;
  }
  return most;
}

/// One significant digit.
double rounded(double value) {
  const double ten = std::pow(10.0, std::floor(std::log10(value)));
  return std::round(value / ten) * ten;
}

}  // namespace

std::string valve_summary(VerdictCode code, const Evidence& evidence) {
  const model::Step* const step = band_step(evidence);
  if (code != VerdictCode::valve_stiction || step == nullptr ||
      step->effect != model::EffectKind::valve_deadband)
    return {};
  return "Hysteresis of the valve keeps the loop cycling: it sticks or has dead band, a stroke "
         "test tells which.";
}

std::string stroke_test_action(const Evidence& evidence) {
  const model::Step* const step = band_step(evidence);
  const double band = step == nullptr ? 0.0 : step->parameters.front().value;
  if (!evidence.op_in_percent || !(band > 0.0))
    return std::string(catalogue_entry(VerdictCode::valve_stiction).action);
  constexpr double kPart = 4.0;
  return "Check in the field: put the controller in manual, step the output by about " +
         text::number(std::max(rounded(band / kPart), kLeastStep)) +
         " % at a time (a quarter of the " + text::number(band) +
         " % found) and watch when the stem moves; then packing, actuator and positioner.";
}

}  // namespace loopscope::core::diagnosis
