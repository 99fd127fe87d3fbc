#include "core/model/selection/step_report.hpp"

#include <algorithm>
#include <cmath>

#include "core/model/effects/effect_catalogue.hpp"
#include "core/model/residual_tests/run_residual_tests.hpp"

namespace loopscope::core::model {
namespace {

/// The record is cut in so many parts, on each of which the effect is fitted again.
constexpr std::size_t kRefits = 4;
/// 95th percentile of Student's t with kRefits - 1 degrees of freedom, over the root of kRefits.
constexpr double kHalfWidth = 2.353 / 2.0;

std::vector<Parameter> parameters_of(const LoopData& data, const Fit& fit, std::size_t place) {
  const Effect& effect = *fit.structure.effects[place];
  return effect.parameters(data, coefficients_of(fit, place), fit.gain());
}

std::vector<Range> within(const std::vector<Range>& ranges, Range part) {
  std::vector<Range> result;
  for (const Range& range : ranges) {
    const Range cut{std::max(range.first, part.first), std::min(range.end, part.end)};
    if (cut.first < cut.end) result.push_back(cut);
  }
  return result;
}

/// The last effect's parameters on one part of the record, the rest of the model as it is.
std::vector<Parameter> on_part(const LoopData& data, const Fit& fit, std::size_t part) {
  LoopData piece = data;
  const Range range{part * data.size() / kRefits, (part + 1) * data.size() / kRefits};
  piece.rows.fit = within(data.rows.fit, range);
  const auto others = within(data.rows.score, range);
  piece.rows.fit.insert(piece.rows.fit.end(), others.begin(), others.end());
  std::ranges::sort(piece.rows.fit, {}, &Range::first);
  return parameters_of(piece, refine_last(piece, evaluate(piece, fit.structure), 0.25),
                       fit.structure.effects.size() - 1);
}

void add_spread(const LoopData& data, const Fit& fit, std::vector<Parameter>& parameters) {
  std::vector<std::vector<Parameter>> parts;
  for (std::size_t part = 0; part < kRefits; ++part) parts.push_back(on_part(data, fit, part));
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    double square = 0.0;
    for (const auto& part : parts) {
      if (i >= part.size()) return;
      square += (part[i].value - parameters[i].value) * (part[i].value - parameters[i].value);
    }
    const double half = kHalfWidth * std::sqrt(square / static_cast<double>(kRefits - 1));
    parameters[i].low = parameters[i].value - half;
    parameters[i].high = parameters[i].value + half;
  }
}

Step report(const LoopData& data, const SelectedEffect& entered) {
  const Fit& fit = entered.fit.fit;
  const Effect& effect = *fit.structure.effects.back();
  const double square = data.pv_scale * data.pv_scale;
  Step step;
  step.effect = effect.kind();
  step.parameters = parameters_of(data, fit, fit.structure.effects.size() - 1);
  if (!traits_of(step.effect).everywhere) add_spread(data, fit, step.parameters);
  step.law = effect.law();
  step.holdout_error_before = entered.comparison.before * square;
  step.holdout_error_after = entered.comparison.after * square;
  step.evidence = entered.comparison.evidence;
  step.p = entered.comparison.p;
  step.margin = step.evidence - entered.rival_evidence;
  step.simulation_ratio = entered.simulation_ratio;
  step.steadiness = entered.comparison.steadiness;
  step.statement = effect.words(step.parameters);
  step.asked_by = asked_by(step.effect, entered.asked_for, entered.left);
  step.promise_rank = entered.promise_rank;
  return step;
}

}  // namespace

std::vector<Step> report_steps(const StepwiseModel& stepwise) {
  std::vector<Step> steps;
  for (const SelectedEffect& entered : stepwise.selected)
    steps.push_back(report(stepwise.data, entered));
  return steps;
}

}  // namespace loopscope::core::model
