#include "core/diagnosis/evidence/structure.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "core/diagnosis/evidence/nonlinearity.hpp"
#include "core/model/effects/effect_catalogue.hpp"

namespace loopscope::core::diagnosis {
namespace {

/// An oscillation that carries less than this share of the error's variance is not what makes the
/// loop perform poorly: those found by chance carry 0.03 to 0.14, real ones 0.24 and more
/// (MEASURED.md).
constexpr double kOscillationShare = 0.2;
/// One healthy loop in a thousand.
constexpr double kStructuredP = 1e-3;

/// What is not a number shows nothing.
double p_or_one(double p) {
  return p >= 0.0 ? std::min(p, 1.0) : 1.0;
}

struct Theme {
  std::string_view question;
  model::EffectKind effect;
};

/// What a residual test sees of an effect that the model has already: lines and grids are asked of
/// pv itself, where they stay; steps and changes leave their place.
constexpr std::array kThemes = {
    Theme{"periodic", model::EffectKind::external_oscillation},
    Theme{"grid", model::EffectKind::sensor_quantisation},
    Theme{"held", model::EffectKind::sensor_hold},
    Theme{"time_event", model::EffectKind::load_step},
    Theme{"time_gain", model::EffectKind::gain_change},
    Theme{"op_direction", model::EffectKind::valve_stiction},
    Theme{"op_direction", model::EffectKind::valve_deadband},
    Theme{"op_level", model::EffectKind::valve_saturation},
    Theme{"op_level", model::EffectKind::valve_characteristic},
    Theme{"response_level", model::EffectKind::process_nonlinearity},
};

bool answered(const model::Question& question, const model::Explanation& explanation) {
  return std::ranges::any_of(kThemes, [&](const Theme& theme) {
    return theme.question == question.name &&
           std::ranges::any_of(explanation.steps, [&](const model::Step& step) {
             return step.effect == theme.effect;
           });
  });
}

}  // namespace

double structure_p(const model::Explanation& explanation) {
  double smallest = p_or_one(explanation.unexplained.whiteness_p);
  for (const model::Question& question : explanation.questions) {
    if (answered(question, explanation)) continue;
    smallest = std::min(smallest, p_or_one(question.p));
  }
  const auto asked = static_cast<double>(explanation.questions.size() + 1);
  return std::min(1.0, asked * smallest);
}

bool is_structured(const Evidence& evidence) {
  if (nonlinear_p(evidence) <= kStructuredP) return true;
  if (oscillates(evidence) && evidence.oscillation.p.value_or(1.0) <= kStructuredP) return true;
  return evidence.model && evidence.model->excited && structure_p(*evidence.model) <= kStructuredP;
}

bool shows_nonlinearity(const Evidence& evidence, double alpha) {
  if (nonlinear_p(evidence) <= alpha) return true;
  if (!evidence.model || !evidence.model->excited) return false;
  const auto bends = [](const auto& found) {
    return model::bends_flow(found.effect) ||
           found.effect == model::EffectKind::process_nonlinearity;
  };
  return std::ranges::any_of(evidence.model->steps, bends) ||
         std::ranges::any_of(evidence.model->asked, bends);
}

bool oscillates(const Evidence& evidence) {
  const double amplitude = evidence.oscillation.amplitude.value_or(0.0);
  const double error_std = evidence.performance.error_std.value_or(0.0);
  return evidence.oscillation.present &&
         0.5 * amplitude * amplitude >= kOscillationShare * error_std * error_std;
}

bool has_flag(const Evidence& evidence, std::string_view flag) {
  return std::ranges::find(evidence.data_quality.flags, flag) != evidence.data_quality.flags.end();
}

bool op_speaks(const Evidence& evidence) {
  return !has_flag(evidence, "op_constant") && !has_flag(evidence, "op_missing");
}

}  // namespace loopscope::core::diagnosis
