#include "core/diagnosis/disturbance_words.hpp"

#include <algorithm>
#include <iterator>
#include <vector>

#include "core/diagnosis/effect_verdict.hpp"
#include "core/model/residual_tests/run_residual_tests.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::diagnosis {
namespace {

using model::EffectKind;

/// The steps of this effect that the verdict counts as coming from outside.
std::vector<model::Step> from_outside(const model::Explanation& explanation, EffectKind effect) {
  std::vector<model::Step> steps;
  std::ranges::copy_if(explanation.steps, std::back_inserter(steps), [&](const model::Step& step) {
    return step.effect == effect && verdict_of(step) == VerdictCode::external_disturbance;
  });
  return steps;
}

double explained_by_all(const std::vector<model::Step>& steps) {
  double sum = 0.0;
  for (const model::Step& step : steps) sum += model::explained_by(step);
  return sum;
}

bool sudden_loads_left(const model::Explanation& explanation) {
  return std::ranges::any_of(explanation.questions, [](const model::Question& question) {
    return question.name == "time_event" && question.p <= model::kNominates;
  });
}

/// Where the load moved, s into the window, in ascending order.
std::vector<double> times_of_loads(const model::Explanation& explanation) {
  std::vector<double> times;
  for (const model::Step& step : from_outside(explanation, EffectKind::load_step)) {
    for (const model::Parameter& parameter : step.parameters) {
      if (parameter.name == "at") times.push_back(parameter.value);
    }
  }
  std::ranges::sort(times);
  return times;
}

std::string times(std::size_t count) {
  return count == 2 ? "twice" : std::to_string(count) + " times";
}

}  // namespace

Disturbance disturbance_of(const model::Explanation& explanation) {
  const auto waves = from_outside(explanation, EffectKind::external_oscillation);
  const auto loads = from_outside(explanation, EffectKind::load_step);
  if (waves.empty() && loads.empty()) return Disturbance::none;
  if (loads.empty() || (!waves.empty() && explained_by_all(waves) >= explained_by_all(loads)))
    return Disturbance::wave;
  if (sudden_loads_left(explanation)) return Disturbance::keeps_moving;
  return load_moves(explanation) < 2 ? Disturbance::moved_once : Disturbance::moved;
}

std::size_t load_moves(const model::Explanation& explanation) {
  const model::ProcessFit& process = explanation.baseline.process;
  const double answer_s = process.delay_s + process.time_constant_s;
  std::size_t count = 0;
  double last_s = 0.0;
  for (const double at_s : times_of_loads(explanation)) {
    if (count == 0 || at_s > last_s + answer_s) ++count;
    last_s = at_s;
  }
  return count;
}

DisturbanceWords words_of(Disturbance disturbance, const model::Explanation& explanation) {
  switch (disturbance) {
    case Disturbance::moved_once:
      return {"The load moved once within the window.",
              "Check what was changed upstream at that time; the loop itself needs no change."};
    case Disturbance::moved:
      return {"The load moved " + times(load_moves(explanation)) + " within the window.",
              "Compare these times with feeds, utilities and the operators' log; where the load "
              "can be measured, consider feedforward."};
    case Disturbance::keeps_moving:
      return {"The load keeps moving.",
              "Check what feeds this loop (supply pressure, upstream level, composition): it "
              "moves without a period. Where it can be measured, consider feedforward."};
    case Disturbance::wave:
    case Disturbance::none:
      break;
  }
  return {"An oscillation reaches the loop from outside.",
          "Find the loop or unit with the same period before changing this loop."};
}

}  // namespace loopscope::core::diagnosis
