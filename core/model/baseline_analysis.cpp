#include "core/model/baseline_analysis.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/model/controller/closed_loop.hpp"
#include "core/model/controller/excitation.hpp"
#include "core/model/controller/inverse_controller_fit.hpp"
#include "core/model/controller/tuning.hpp"
#include "core/model/effects/effect_catalogue.hpp"
#include "core/model/fit/noise_floor.hpp"
#include "core/model/fit/process_report.hpp"
#include "core/model/limit_cycle/apply_limit_cycle_evidence.hpp"
#include "core/model/residual_tests/run_residual_tests.hpp"
#include "core/model/selection/step_report.hpp"
#include "core/model/selection/steps_after_moves.hpp"

namespace loopscope::core::model {
namespace {

/// Below so much of the baseline's error there is nothing to explain.
constexpr double kLeastExplainable = 0.02;
/// A question that finds so little chance describes what is left.
constexpr double kStructuredP = 1e-3;

/// What lowers the error on unseen rows so clearly by bending the way from op to pv shows that op
/// moves pv, wherever the general measures draw the line.
bool shows_that_op_acts(const Step& step) {
  constexpr double kPlain = 100.0;  // a chance of 1e-22
  return step.evidence >= kPlain && !is_from_outside(step.effect);
}

/// How old a value of pv is in the mean when the controller reads it, samples.
std::size_t age_of_pv(const RowGrid& grid) {
  return (grid.samples_per_row - 1) / 2;
}

/// The loop that the controller makes with the process and a sensor that may be held.
ClosedLoop implied_loop(const LoopData& data, const Fit& fit, const ProcessFit& process,
                        const ControllerLaw& law) {
  const std::size_t age = age_of_pv(data.grid);
  SampledProcess seen = sampled(data, fit);
  seen.delay_samples += age;
  ClosedLoop loop = close_loop(seen, law, data.sample_interval_s);
  ProcessFit later = process;
  later.delay_s += static_cast<double>(age) * data.sample_interval_s;
  loop.slowness = judge_tuning(later, law, data.sample_interval_s).slowness;
  return loop;
}

/// Excitation and closed loop; returns the turns of op.
std::size_t judge_loop(const BaselineAnalysis& analysis, const Fit& fit, Explanation& explanation) {
  const LoopData& data = analysis.stepwise.data;
  const ModelInput& rows = analysis.at_rows;
  const std::vector<double> response = response_of(data, fit);
  const Excitation excitation = judge_excitation({rows.op, rows.pv, rows.op_in_percent, response});
  explanation.excited = excitation.sufficient;
  explanation.excitation = excitation.statement;
  if (!excitation.sufficient && std::ranges::any_of(explanation.steps, shows_that_op_acts)) {
    explanation.excited = true;
    explanation.excitation = "Excited: the effects found show that op moves pv.";
  }
  const ModelInput& input = analysis.recorded;
  if (input.error.empty()) return excitation.reversals;
  const ControllerLaw law =
      find_controller_law({input.error, input.sp, input.op, input.op_in_percent});
  if (!law.found) return excitation.reversals;
  const ProcessFit& process = explanation.baseline.process;
  const InverseControllerFit trap =
      judge_inverse_controller_fit(process, law, input.op, input.sample_interval_s);
  const bool refused = trap.refused && input.without.keeps(Mechanism::inverse_controller_fit);
  if (refused && explanation.steps.empty()) {
    explanation.process_doubt = trap.statement;
    return excitation.reversals;
  }
  if (process.gain != 0.0 && !refused)
    explanation.closed_loop = implied_loop(data, fit, process, law);
  return excitation.reversals;
}

/// What the effects that were selected so far leave unexplained.
void report_rest(const StepwiseModel& stepwise, const std::vector<TestOutcome>& answers,
                 Explanation& explanation) {
  const double square = stepwise.data.pv_scale * stepwise.data.pv_scale;
  const double after = stepwise.last().fit.score_error * square;
  explanation.noise_floor = noise_floor(stepwise.data, stepwise.last().fit) * square;
  const double explainable = std::max(explanation.baseline.holdout_error - explanation.noise_floor,
                                      kLeastExplainable * explanation.baseline.holdout_error);
  Unexplained& rest = explanation.unexplained;
  rest.fraction = std::clamp((after - explanation.noise_floor) / explainable, 0.0, 1.0);
  rest.whiteness_p = p_of(answers, "white");
  for (const TestOutcome& answer : answers) {
    const Question& asked = answer.question;
    explanation.questions.push_back(asked);
    if (asked.name == "ngi") rest.ngi_p = asked.p;
    if (asked.p > kStructuredP || asked.statement.empty()) continue;
    rest.statement += (rest.statement.empty() ? "" : " ") + asked.statement;
  }
}

}  // namespace

double BaselineAnalysis::baseline_error() const {
  return stepwise.baseline.fit.score_error * stepwise.data.pv_scale * stepwise.data.pv_scale;
}

double BaselineAnalysis::error_of_both_halves() const {
  return compare(stepwise.data, stepwise.baseline, stepwise.baseline).after *
         stepwise.data.pv_scale * stepwise.data.pv_scale;
}

BaselineAnalysis analyse_baseline(const ModelInput& recorded, const ModelInput& at_rows,
                                  const RowGrid& grid) {
  LoopData data = make_loop_data(recorded.pv, recorded.op, recorded.sample_interval_s, grid);
  data.without = recorded.without;
  BaselineAnalysis analysis{recorded, at_rows, start_selection(data), {}};
  analysis.answers =
      run_residual_tests(at_rows, analysis.stepwise.data, analysis.stepwise.baseline.fit);
  return analysis;
}

BaselineAnalysis analyse_baseline(const ModelInput& recorded) {
  return analyse_baseline(recorded, recorded, {});
}

void report_linear_rest(const BaselineAnalysis& analysis, Explanation& explanation) {
  report_rest(analysis.stepwise, analysis.answers, explanation);
}

Explanation begin_explanation(const BaselineAnalysis& analysis) {
  const LoopData& data = analysis.stepwise.data;
  const Fit& linear = analysis.stepwise.baseline.fit;
  Explanation explanation;
  explanation.baseline = {describe(data, linear), analysis.baseline_error(),
                          report_process(data, linear)};
  return explanation;
}

Explanation select_and_report(BaselineAnalysis& analysis) {
  Explanation explanation = begin_explanation(analysis);
  StepwiseModel& stepwise = analysis.stepwise;
  explanation.asked = asked_effects(analysis.answers);
  const std::vector<TestOutcome>* others = analysis.recorded.without.others();
  std::vector<TestOutcome> left = select_effects(
      stepwise, others ? *others : analysis.answers, [&](const LoopData& data, const Fit& fit) {
        return others ? *others : run_residual_tests(analysis.at_rows, data, fit);
      });
  explanation.steps = report_steps(stepwise);
  const Fit& last = stepwise.last().fit;
  const bool changed = !stepwise.selected.empty();
  if (changed) explanation.baseline.process = report_process(stepwise.data, last);
  for (TestOutcome& answer : run_coupling_tests(stepwise.data, last, analysis.at_rows.seed))
    left.push_back(std::move(answer));
  const std::size_t op_turns = judge_loop(analysis, last, explanation);
  report_rest(stepwise, left, explanation);
  // Behind a held sensor the shape of a cycle proves nothing: there it accused the valves of 5 in
  // 640 healthy loops, and none of 40 that stick and were not found without it.
  if (stepwise.data.grid.every_sample() &&
      analysis.recorded.without.keeps(Mechanism::hysteresis_by_cycle))
    apply_limit_cycle_evidence(analysis.recorded, analysis.answers, left, op_turns, explanation);
  if (analysis.recorded.without.keeps(Mechanism::steps_after_moves))
    find_steps_after_moves(analysis.recorded, stepwise.data.grid.samples_per_row, explanation);
  return explanation;
}

Explanation report_linear_model(const BaselineAnalysis& analysis) {
  Explanation explanation = begin_explanation(analysis);
  judge_loop(analysis, analysis.stepwise.baseline.fit, explanation);
  report_linear_rest(analysis, explanation);
  return explanation;
}

}  // namespace loopscope::core::model
