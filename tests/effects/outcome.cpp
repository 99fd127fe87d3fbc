#include "tests/effects/outcome.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string_view>

#include "core/model/effects/effect_catalogue.hpp"

namespace loopscope::tests::effects {
namespace {

using core::model::ErrorKind;
using core::model::Explanation;
using core::model::Step;

template <typename Range>
bool contains(const Range& range, std::string_view word) {
  return std::find(std::begin(range), std::end(range), word) != std::end(range);
}

/// Of effects and verdicts alike: a fitter would be sent to the valve, the vessel or the sensor.
bool is_hardware(std::string_view word) {
  return word.starts_with("valve_") || word.starts_with("process_") ||
         word.starts_with("sensor_") || word == "gain_change";
}

bool names_a_cause(std::string_view verdict) {
  constexpr std::array<std::string_view, 4> kNoCause = {"healthy", "nonlinear_unexplained",
                                                        "unexplained", "insufficient_data"};
  return !contains(kNoCause, verdict);
}

bool first_is_right(const Outcome& outcome, const KindInfo& kind) {
  if (kind.effects.empty())
    return kind.hardware_is_wrong
               ? std::none_of(outcome.steps.begin(), outcome.steps.end(), is_hardware)
               : true;
  return !outcome.steps.empty() && contains(kind.effects, outcome.steps.front());
}

/// By the size of the figure; a time by the length of the record, since its origin is arbitrary.
double relative_error(const TrueParameter& truth, double value, const Record& record) {
  const double length = record.interval_s * static_cast<double>(record.pv.size());
  return std::abs(value - truth.value) / (truth.name == "at" ? length : std::abs(truth.value));
}

/// Errors of one step against one true effect, by name of the parameter.
std::map<std::string, double> errors_of(const Step& step, const TrueEffect& effect,
                                        const Record& record) {
  std::map<std::string, double> errors;
  for (const TrueParameter& truth : effect.parameters)
    for (const auto& parameter : step.parameters)
      if (parameter.name == truth.name)
        errors[effect.effect + "." + truth.name] = relative_error(truth, parameter.value, record);
  return errors;
}

double sum(const std::map<std::string, double>& errors) {
  double total = 0.0;
  for (const auto& [name, error] : errors) total += error;
  return total;
}

/// Against the true effect of the same name that lies nearest: load steps come in several.
void measure_parameters(Outcome& outcome, const Step& step, const Record& record) {
  std::map<std::string, double> best;
  double least = std::numeric_limits<double>::infinity();
  for (const TrueEffect& effect : record.truth.effects) {
    if (effect.effect != name(step.effect)) continue;
    const std::map<std::string, double> errors = errors_of(step, effect, record);
    if (sum(errors) >= least) continue;
    least = sum(errors);
    best = errors;
  }
  outcome.parameter_errors.insert(best.begin(), best.end());
}

void measure_errors(Outcome& outcome, const Explanation& model, double floor) {
  outcome.model_floor = model.noise_floor / floor;
  if (model.error_kind != ErrorKind::one_step) return;
  const bool steps = !model.steps.empty();
  outcome.error_before =
      (steps ? model.steps.front().holdout_error_before : model.baseline.holdout_error) / floor;
  outcome.error_after =
      (steps ? model.steps.back().holdout_error_after : model.baseline.holdout_error) / floor;
}

void judge_model(Outcome& outcome, const Record& record, const Explanation& model) {
  const KindInfo& kind = record.truth.kind;
  outcome.modelled = true;
  for (const Step& step : model.steps) {
    outcome.steps.emplace_back(name(step.effect));
    measure_parameters(outcome, step, record);
    outcome.asked_for.push_back(!step.asked_by.empty());
  }
  if (!model.steps.empty()) outcome.first_rank = model.steps.front().promise_rank;
  outcome.named_right = first_is_right(outcome, kind);
  outcome.all_found =
      std::all_of(kind.effects.begin(), kind.effects.end(),
                  [&](const std::string& effect) { return contains(outcome.steps, effect); });
  outcome.accuses_hardware |= std::any_of(outcome.steps.begin(), outcome.steps.end(), is_hardware);
  measure_errors(outcome, model, record.truth.floor);
}

}  // namespace

Outcome judge(const Record& record, const std::string& verdict, double confidence,
              const Explanation* model) {
  Outcome outcome;
  outcome.verdict = verdict;
  outcome.confidence = confidence;
  outcome.verdict_right = contains(record.truth.kind.verdicts, verdict);
  outcome.accuses_hardware = is_hardware(verdict);
  outcome.explainable = record.truth.explainable;
  outcome.misleads = !outcome.verdict_right && names_a_cause(verdict);
  if (model != nullptr) judge_model(outcome, record, *model);
  return outcome;
}

}  // namespace loopscope::tests::effects
