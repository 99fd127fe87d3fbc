#include "core/diagnosis/model_confidence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "core/diagnosis/leading_effect.hpp"

namespace loopscope::core::diagnosis {
namespace {

/// No model of routine data is surer than a recorded valve position (0.9 in decide.cpp) by more.
constexpr double kMostConfident = 0.95;
/// Evidence is twice a log likelihood ratio: chi squared with a handful of degrees of freedom when
/// there is nothing, so that 15 is a marginal and 45 a clear finding.
constexpr double kEvidenceScale = 15.0;
/// The exact odds of two hypotheses would take 2; models of real loops are never exact.
constexpr double kMarginScale = 10.0;
/// Of the confidence when the steps explain nothing of what could be explained.
constexpr double kNothingExplained = 0.4;
/// Whatever causes the structure may cause what the effect seems to explain.
constexpr double kMostWithStructure = 0.6;
/// Before its time is looked at, one load step in ten stands for something the model lacks.
constexpr double kOddsOfMisfit = 1.0 / 9.0;
/// One healthy loop in a thousand: below, the residual counts as structured.
constexpr double kStructuredP = 1e-3;

/// Of 5700 healthy loops 0.012 lead with an effect of evidence 30 and more, 0.0044 of 40, 0.0016 of
/// 53, 0.0007 of 72, 0.0004 of 104.
constexpr double kHealthyShare = 0.02;
constexpr double kHealthyScale = 25.0;

/// What is not a number shows nothing.
double p_or_one(double p) {
  return p >= 0.0 ? std::min(p, 1.0) : 1.0;
}

double share_or(double share, double otherwise) {
  return std::isnan(share) ? otherwise : std::clamp(share, 0.0, 1.0);
}

struct Theme {
  std::string_view question;
  model::EffectKind effect;
};

/// What a question sees of an effect that the model has already: lines and grids are asked of pv
/// itself, where they stay; steps and changes leave their place.
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

double evidence_factor(const model::Step& step) {
  return step.evidence > 0.0 ? 1.0 - std::exp(-step.evidence / kEvidenceScale) : 0.0;
}

double margin_factor(const model::Step& step) {
  const double margin = std::isnan(step.margin) ? 0.0 : step.margin;
  return 1.0 / (1.0 + std::exp(-margin / kMarginScale));
}

bool happens_once(model::EffectKind effect) {
  return effect == model::EffectKind::load_step || effect == model::EffectKind::gain_change;
}

double steadiness_factor(const model::Step& step) {
  return happens_once(step.effect) ? 1.0 : 0.5 + 0.5 * share_or(step.steadiness, 0.0);
}

/// Bayes: how likely a load step that comes with the answer to the setpoint is a load, and how
/// likely it is none where that is what the verdict rests on.
double timing_factor(const model::Step& step, VerdictCode code) {
  if (step.setpoint_chance >= 1.0) return 1.0;
  const double load = step.setpoint_chance / (step.setpoint_chance + kOddsOfMisfit);
  return code == VerdictCode::unexplained ? 1.0 - load : load;
}

double explained_factor(const model::Unexplained& unexplained) {
  const double explained = 1.0 - share_or(unexplained.fraction, 1.0);
  return kNothingExplained + (1.0 - kNothingExplained) * explained;
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

bool leaves_structure(const model::Explanation& explanation) {
  return structure_p(explanation) <= kStructuredP;
}

double held_by_structure(double confidence, const model::Explanation& explanation) {
  return leaves_structure(explanation) ? std::min(confidence, kMostWithStructure) : confidence;
}

double measured_p(const model::Step& step) {
  if (!(step.evidence >= 0.0)) return 1.0;
  const double among_healthy = kHealthyShare * std::exp(-step.evidence / kHealthyScale);
  return std::clamp(among_healthy, p_or_one(step.p), 1.0);
}

double confidence_of(const model::Explanation& explanation) {
  if (explanation.steps.empty()) return 0.0;
  const LeadingEffect leading = leading_effect(explanation);
  const model::Step& step = *leading.strongest;
  const double agreement = 0.5 + 0.5 * leading.share;
  const double confidence = kMostConfident * evidence_factor(step) * margin_factor(step) *
                            steadiness_factor(step) * timing_factor(step, leading.code) *
                            explained_factor(explanation.unexplained) * agreement;
  return held_by_structure(confidence, explanation);
}

}  // namespace loopscope::core::diagnosis
