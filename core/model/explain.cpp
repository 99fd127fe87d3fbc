#include "core/model/explain.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/model/closed_loop.hpp"
#include "core/model/controller_trap.hpp"
#include "core/model/excitation.hpp"
#include "core/model/noise_floor.hpp"
#include "core/model/prefer_hysteresis.hpp"
#include "core/model/process_report.hpp"
#include "core/model/put_questions.hpp"
#include "core/model/renewed_record.hpp"
#include "core/model/sensor_steps.hpp"
#include "core/model/step_report.hpp"
#include "core/model/story.hpp"
#include "core/model/tuning.hpp"
#include "core/signal/spread.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::size_t kFewestSamples = 400;
/// Below so much of the baseline's error there is nothing to explain.
constexpr double kLeastExplainable = 0.02;
/// A question that finds so little chance describes what is left.
constexpr double kStructuredP = 1e-3;

/// Sums of fourth powers of larger values would no longer be finite.
constexpr double kLargestValue = 1e70;

bool varies(std::span<const double> values) {
  const auto spread = signal::measure_spread(values);
  return spread && !spread->constant() && std::max(-spread->low, spread->high) < kLargestValue;
}

bool fittable(const ModelInput& input) {
  if (input.op.empty()) return false;
  if (input.op.size() != input.pv.size())
    throw std::invalid_argument("explain: op and pv differ in length");
  std::size_t both = 0;
  for (std::size_t k = 0; k < input.pv.size(); ++k) {
    if (std::isfinite(input.pv[k]) && std::isfinite(input.op[k])) ++both;
    if (std::isinf(input.pv[k]) || std::isinf(input.op[k])) return false;
  }
  return both >= kFewestSamples && varies(input.pv) && varies(input.op);
}

/// What lowers the error on unseen rows so clearly by bending the way from op to pv shows that op
/// moves pv, wherever the general measures draw the line.
bool shows_that_op_acts(const Step& step) {
  constexpr double kPlain = 100.0;  // a chance of 1e-22
  return step.evidence >= kPlain && !same_cause(step.effect, EffectKind::load_step);
}

/// Excitation and closed loop; returns the turns of op.
std::size_t judge_loop(const ModelInput& input, const LoopData& data, const Fit& fit,
                       Explanation& explanation) {
  const std::vector<double> response = response_of(data, fit);
  const Excitation excitation =
      judge_excitation({input.op, input.pv, input.op_in_percent, response});
  explanation.excited = excitation.sufficient;
  explanation.excitation = excitation.statement;
  if (!excitation.sufficient && std::ranges::any_of(explanation.steps, shows_that_op_acts)) {
    explanation.excited = true;
    explanation.excitation = "Excited: the effects found show that op moves pv.";
  }
  if (input.error.empty()) return excitation.reversals;
  const ControllerLaw law =
      find_controller_law({input.error, input.sp, input.op, input.op_in_percent});
  if (!law.found) return excitation.reversals;
  const ProcessFit& process = explanation.baseline.process;
  const ControllerTrap trap =
      judge_controller_trap(process, law, input.op, input.sample_interval_s);
  if (trap.refused && explanation.steps.empty()) {
    explanation.process_doubt = trap.statement;
    return excitation.reversals;
  }
  if (process.gain != 0.0 && !trap.refused) {
    const TuningJudgement judged = judge_tuning(process, law, input.sample_interval_s);
    explanation.closed_loop = close_loop(sampled(data, fit), law, input.sample_interval_s);
    explanation.closed_loop->slowness = judged.slowness;
  }
  return excitation.reversals;
}

void report_rest(const Story& story, const std::vector<Answer>& answers, Explanation& explanation) {
  const double square = story.data.pv_scale * story.data.pv_scale;
  const double after = story.last().fit.score_error * square;
  explanation.noise_floor = noise_floor(story.data, story.last().fit) * square;
  const double explainable = std::max(explanation.baseline.holdout_error - explanation.noise_floor,
                                      kLeastExplainable * explanation.baseline.holdout_error);
  Unexplained& rest = explanation.unexplained;
  rest.fraction = std::clamp((after - explanation.noise_floor) / explainable, 0.0, 1.0);
  rest.whiteness_p = p_of(answers, "white");
  for (const Answer& answer : answers) {
    const Question& asked = answer.question;
    explanation.questions.push_back(asked);
    if (asked.name == "ngi") rest.ngi_p = asked.p;
    if (asked.p > kStructuredP || asked.statement.empty()) continue;
    rest.statement += (rest.statement.empty() ? "" : " ") + asked.statement;
  }
}

/// The linear loop and what its residual says.
struct Look {
  Story story;
  std::vector<Answer> answers;
  [[nodiscard]] double baseline_error() const {
    return story.baseline.fit.score_error * story.data.pv_scale * story.data.pv_scale;
  }
};

Look look_at(const ModelInput& input) {
  Look look{begin_story(make_loop_data(input.pv, input.op, input.sample_interval_s)), {}};
  look.answers = question(input, look.story.data, look.story.baseline.fit, Depth::quick);
  return look;
}

Explanation explain_look(const ModelInput& input, Look look) {
  Story& story = look.story;
  Explanation explanation;
  const Fit& linear = story.baseline.fit;
  explanation.baseline = {describe(story.data, linear), look.baseline_error(),
                          report_process(story.data, linear)};
  continue_story(story, look.answers);
  explanation.steps = report_steps(story);
  const Fit& last = story.last().fit;
  if (!story.chapters.empty()) explanation.baseline.process = report_process(story.data, last);
  const std::vector<Answer> left = question(input, story.data, last, Depth::full);
  const std::size_t op_turns = judge_loop(input, story.data, last, explanation);
  report_rest(story, left, explanation);
  prefer_hysteresis(input, look.answers, left, op_turns, explanation);
  return explanation;
}

bool has_rows(const Look& look) {
  constexpr std::size_t kFewestRows = 100;
  return look.story.data.rows.fit_count() >= kFewestRows &&
         look.story.data.rows.score_count() >= kFewestRows;
}

/// Errors of renewals as mean squares over all samples: between renewals pv is known.
void spread_over(Explanation& explanation, double share) {
  explanation.noise_floor *= share;
  explanation.baseline.holdout_error *= share;
  for (Step& step : explanation.steps) {
    step.holdout_error_before *= share;
    step.holdout_error_after *= share;
  }
}

/// Of a held sensor only the renewals say anything: the story is told on them.
/// nullopt where too few are left to fit.
std::optional<Explanation> explain_renewals(const ModelInput& input, Step hold,
                                            std::size_t hold_samples) {
  const RenewedRecord renewed =
      renewed_record(input.pv, input.op, input.sp, input.error, hold_samples);
  const double share = 1.0 / static_cast<double>(hold_samples);
  const ModelInput thinned{
      renewed.pv,          renewed.op, renewed.sp, renewed.error, input.sample_interval_s / share,
      input.op_in_percent, input.seed};
  if (!fittable(thinned)) return std::nullopt;
  const Look look = look_at(thinned);
  if (!has_rows(look)) return std::nullopt;
  Explanation explanation = explain_look(thinned, look);
  spread_over(explanation, share);
  hold.holdout_error_after = explanation.baseline.holdout_error;
  explanation.noise_floor = std::min(explanation.noise_floor, hold.holdout_error_after);
  explanation.baseline.holdout_error = hold.holdout_error_before;
  explanation.steps.insert(explanation.steps.begin(), std::move(hold));
  return explanation;
}

/// pv is a function of op up to rounding: one of the two was computed from the other.
bool too_good(const Look& look) {
  constexpr double kRounding = 1e-8;  // of pv's variance
  return look.story.baseline.fit.score_error < kRounding;
}

Explanation refused(Look look) {
  const LoopData& data = look.story.data;
  const Fit& linear = look.story.baseline.fit;
  Explanation explanation;
  explanation.baseline = {describe(data, linear), look.baseline_error(),
                          report_process(data, linear)};
  explanation.noise_floor = look.baseline_error();
  explanation.excitation =
      "Not excited: op predicts pv up to rounding, as the controller run backwards does.";
  explanation.process_doubt = explanation.excitation;
  report_rest(look.story, look.answers, explanation);
  return explanation;
}

}  // namespace

std::optional<Explanation> explain(const ModelInput& input) {
  if (!fittable(input)) return std::nullopt;
  const Look look = look_at(input);
  if (!has_rows(look)) return std::nullopt;
  if (too_good(look)) return refused(look);
  const SensorFinding sensor = find_sensor_steps(look.baseline_error(), look.answers);
  std::optional<Explanation> on_renewals;
  if (sensor.hold) on_renewals = explain_renewals(input, *sensor.hold, sensor.hold_samples);
  Explanation explanation = on_renewals ? std::move(*on_renewals) : explain_look(input, look);
  if (sensor.hold && !on_renewals)
    explanation.steps.insert(explanation.steps.begin(), *sensor.hold);
  if (sensor.quantisation)
    explanation.steps.insert(explanation.steps.begin(), *sensor.quantisation);
  return explanation;
}

}  // namespace loopscope::core::model
