#include "core/diagnosis/evidence/step_figures.hpp"

#include <algorithm>
#include <array>

#include "core/diagnosis/evidence/structure.hpp"
#include "core/model/effects/effect_catalogue.hpp"
#include "core/model/limit_cycle/cycle_valve.hpp"

namespace loopscope::core::diagnosis {
namespace {

using model::EffectKind;
using Value = std::optional<double>;

/// A model that is not excited claims nothing of the way from op to pv.
bool claims(const Evidence& evidence, EffectKind effect) {
  return evidence.model && (evidence.model->excited || model::is_from_outside(effect));
}

template <typename Of>
double sum_over(const model::Explanation& model, EffectKind effect, Of of) {
  double sum = 0.0;
  for (const model::Step& step : model.steps) {
    if (step.effect == effect) sum += of(step);
  }
  return sum;
}

template <EffectKind effect>
Value evidence_of(const Evidence& evidence) {
  if (!claims(evidence, effect)) return std::nullopt;
  return std::max(0.0, sum_over(*evidence.model, effect,
                                [](const model::Step& step) { return step.evidence; }));
}

/// Of what all steps explain.
template <EffectKind effect>
Value share_of(const Evidence& evidence) {
  if (!claims(evidence, effect)) return std::nullopt;
  double all = 0.0;
  for (const model::Step& step : evidence.model->steps) all += model::explained_by(step);
  const double own = sum_over(*evidence.model, effect,
                              [](const model::Step& step) { return model::explained_by(step); });
  return all > 0.0 ? own / all : 0.0;
}

/// The residual tests of the linear loop.
template <EffectKind effect>
Value asked_for(const Evidence& evidence) {
  if (!claims(evidence, effect)) return std::nullopt;
  double p = 1.0;
  for (const model::AskedEffect& asked : evidence.model->asked) {
    if (asked.effect == effect) p = std::min(p, asked.p);
  }
  return decades(p);
}

/// Of the final residual.
Value left_of(const Evidence& evidence, std::string_view test) {
  if (!evidence.model || !evidence.model->excited) return std::nullopt;
  for (const model::Question& question : evidence.model->questions) {
    if (question.name == test) return decades(question.p);
  }
  return std::nullopt;
}

/// The step of a valve that sticks or has play, with the most evidence; nullptr = there is none.
const model::Step* hysteresis(const Evidence& evidence) {
  const model::Step* found = nullptr;
  if (!claims(evidence, EffectKind::valve_stiction)) return found;
  for (const model::Step& step : evidence.model->steps) {
    const bool has_band = model::is_valve_hysteresis(step.effect) && !step.parameters.empty();
    if (has_band && (!found || step.evidence > found->evidence)) found = &step;
  }
  return found;
}

/// S, or the width of play.
double band_of(const model::Step& step) {
  return step.parameters.front().value;
}

Value band_of_travel(const Evidence& evidence) {
  const model::Step* step = hysteresis(evidence);
  if (!step || !evidence.cycle || !(evidence.cycle->evidence.travel > 0.0)) return std::nullopt;
  return band_of(*step) / evidence.cycle->evidence.travel;
}

Value odds_of_cycle(const Evidence& evidence) {
  const model::Step* step = hysteresis(evidence);
  if (!step || !evidence.cycle) return std::nullopt;
  return model::odds_that_valve_cycles(*evidence.cycle, band_of(*step));
}

Value jump_of_band(const Evidence& evidence) {
  const model::Step* step = hysteresis(evidence);
  if (!step || !(band_of(*step) > 0.0)) return std::nullopt;
  return step->parameters.size() < 2 ? 0.0 : step->parameters[1].value / band_of(*step);
}

template <auto member>
Value of_hysteresis(const Evidence& evidence) {
  const model::Step* step = hysteresis(evidence);
  if (!step) return std::nullopt;
  return static_cast<double>(step->*member);
}

/// Behind a process that integrates a loop cycles about play as well as about a valve that sticks.
Value as_if_stuck(const Evidence& evidence) {
  if (evidence.integrating) return std::nullopt;
  if (evidence.cycle && !model::follows_in_cycle(evidence.cycle->evidence)) return std::nullopt;
  return of_hysteresis<&model::Step::cycle_indicates_stiction>(evidence);
}

Value all_hysteresis(const Evidence& evidence) {
  const Value sticks = evidence_of<EffectKind::valve_stiction>(evidence);
  if (!sticks) return std::nullopt;
  return *sticks + *evidence_of<EffectKind::valve_deadband>(evidence);
}

Value direction_left(const Evidence& evidence) {
  return left_of(evidence, "op_direction");
}

/// Of load steps that come when the loop answers its setpoint.
Value chance_of_loads(const Evidence& evidence) {
  if (!evidence.model) return std::nullopt;
  double p = 1.0;
  for (const model::Step& step : evidence.model->steps) p = std::min(p, step.setpoint_chance);
  return decades(p);
}

Value structure_left(const Evidence& evidence) {
  if (!evidence.model || !evidence.model->excited) return std::nullopt;
  return decades(structure_p(*evidence.model));
}

constexpr std::array kStepFigures = {
    Figure{"step.valve_stiction", "evidence for a sticking valve on held-out samples", Scale::plain,
           evidence_of<EffectKind::valve_stiction>},
    Figure{"step.valve_deadband", "evidence for dead band on held-out samples", Scale::plain,
           evidence_of<EffectKind::valve_deadband>},
    Figure{"step.hysteresis", "evidence for friction or dead band of the valve on held-out samples",
           Scale::plain, all_hysteresis},
    Figure{"step.valve_saturation", "evidence for a limit of the valve on held-out samples",
           Scale::plain, evidence_of<EffectKind::valve_saturation>},
    Figure{"step.valve_characteristic", "evidence for a curved characteristic on held-out samples",
           Scale::plain, evidence_of<EffectKind::valve_characteristic>},
    Figure{"step.process_nonlinearity", "evidence for a nonlinear process on held-out samples",
           Scale::plain, evidence_of<EffectKind::process_nonlinearity>},
    Figure{"step.external_oscillation", "evidence for an external oscillation on held-out samples",
           Scale::plain, evidence_of<EffectKind::external_oscillation>},
    Figure{"step.load_step", "evidence for load steps on held-out samples", Scale::plain,
           evidence_of<EffectKind::load_step>},
    Figure{"step.gain_change", "evidence for a changed process gain on held-out samples",
           Scale::plain, evidence_of<EffectKind::gain_change>},
    Figure{"step.sensor_quantisation", "evidence for a coarse sensor on held-out samples",
           Scale::plain, evidence_of<EffectKind::sensor_quantisation>},
    Figure{"step.sensor_hold", "evidence for a sensor that holds its value on held-out samples",
           Scale::plain, evidence_of<EffectKind::sensor_hold>},
    Figure{"share.valve_characteristic",
           "a curved characteristic's share of what the model's steps explain", Scale::share,
           share_of<EffectKind::valve_characteristic>},
    Figure{"share.process_nonlinearity",
           "a nonlinear process's share of what the model's steps explain", Scale::share,
           share_of<EffectKind::process_nonlinearity>},
    Figure{"share.external_oscillation",
           "an external oscillation: share of what the model's steps explain", Scale::share,
           share_of<EffectKind::external_oscillation>},
    Figure{"share.gain_change", "a changed gain's share of what the model's steps explain",
           Scale::share, share_of<EffectKind::gain_change>},
    Figure{"asked.valve_stiction", "the linear model's residual depends on op's direction",
           Scale::decades, asked_for<EffectKind::valve_stiction>},
    Figure{"asked.valve_characteristic", "the linear model's residual depends on op's level",
           Scale::decades, asked_for<EffectKind::valve_characteristic>},
    Figure{"asked.process_nonlinearity", "the linear model's residual depends on pv's level",
           Scale::decades, asked_for<EffectKind::process_nonlinearity>},
    Figure{"asked.external_oscillation", "the linear model's residual is periodic", Scale::decades,
           asked_for<EffectKind::external_oscillation>},
    Figure{"asked.load_step", "the linear model's residual holds sudden loads", Scale::decades,
           asked_for<EffectKind::load_step>},
    Figure{"asked.gain_change", "the linear model's residual shows a change of gain",
           Scale::decades, asked_for<EffectKind::gain_change>},
    Figure{"left.direction_without_friction",
           "op's direction shows in the residual of a model without friction", Scale::decades,
           [](const Evidence& e) { return hysteresis(e) ? std::nullopt : direction_left(e); }},
    Figure{"left.direction_behind_friction",
           "op's direction still shows in the residual behind the model's friction", Scale::decades,
           [](const Evidence& e) { return hysteresis(e) ? direction_left(e) : std::nullopt; }},
    Figure{"left.op_level", "op's level still shows in the model's residual", Scale::decades,
           [](const Evidence& e) { return left_of(e, "op_level"); }},
    Figure{"left.periodic", "lines are left in the model's residual or in pv", Scale::decades,
           [](const Evidence& e) { return left_of(e, "periodic"); }},
    Figure{"left.time_gain", "a change of gain is left in the model's residual", Scale::decades,
           [](const Evidence& e) { return left_of(e, "time_gain"); }},
    Figure{"left.time_spread", "the residual's variance changes with time", Scale::decades,
           [](const Evidence& e) { return left_of(e, "time_spread"); }},
    Figure{"left.response_level", "the response depends on pv's level in the model's residual",
           Scale::decades, [](const Evidence& e) { return left_of(e, "response_level"); }},
    Figure{"left.structure", "the residual is not noise", Scale::decades, structure_left},
    Figure{"band.of_travel", "the valve's band over op's travel in the cycle", Scale::plain,
           band_of_travel},
    Figure{"band.odds", "log odds that a valve with this band makes the cycle", Scale::plain,
           odds_of_cycle},
    Figure{"band.jump", "the valve's slip jump over its stickband", Scale::share, jump_of_band},
    Figure{"band.as_if_stuck", "the loop keeps cycling across the dead band", Scale::yes_no,
           as_if_stuck},
    Figure{"loads.after_moves", "load steps come with the loop's answers to its setpoint",
           Scale::decades, chance_of_loads},
};

}  // namespace

std::span<const Figure> step_figures() {
  return kStepFigures;
}

}  // namespace loopscope::core::diagnosis
