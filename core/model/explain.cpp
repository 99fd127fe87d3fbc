#include "core/model/explain.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/model/baseline_analysis.hpp"
#include "core/model/record/held_sensor_record.hpp"
#include "core/model/residual_tests/sensor_steps.hpp"
#include "core/signal/order/order_statistic.hpp"
#include "core/signal/order/spread.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::size_t kFewestForModel = 400;
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
  return both >= kFewestForModel && varies(input.pv) && varies(input.op);
}

/// pv stands at one value but for fewer samples than a linear loop has parameters: those are no
/// answer to op, and what a fit leaves everywhere else is rounding.
bool rests(std::span<const double> pv) {
  constexpr std::ptrdiff_t kParameters =
      12;  // two taps, delay, two poles, offset, six of the noise
  std::vector<double> recorded;
  std::ranges::copy_if(pv, std::back_inserter(recorded),
                       [](double value) { return std::isfinite(value); });
  const double usual = signal::median(recorded);
  return std::ranges::count_if(recorded, [&](double value) { return value != usual; }) <
         kParameters;
}

/// `fewest` rows of each kind.
bool has_rows(const BaselineAnalysis& analysis, std::size_t fewest) {
  const Rows& rows = analysis.stepwise.data.rows;
  return rows.fit_count() >= fewest && rows.score_count() >= fewest;
}

void add_first(const Step& step, Explanation& explanation) {
  explanation.steps.insert(explanation.steps.begin(), step);
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

/// Of a held sensor only the renewals say anything of pv: the model is fitted to them, with op as
/// it was recorded. nullopt where too few are left to fit.
std::optional<FittedLoop> tell_renewals(const ModelInput& input, BaselineAnalysis& samples,
                                        Step hold, std::size_t hold_samples) {
  constexpr std::size_t kFewestRenewals = 60;  // of each kind: eight for each parameter of a model
  const RenewedRecord renewed =
      renewed_record(input.pv, input.op, input.sp, input.error, hold_samples);
  const double share = 1.0 / static_cast<double>(hold_samples);
  const ModelInput at_rows{
      renewed.pv,          renewed.op, renewed.sp,   renewed.error, input.sample_interval_s / share,
      input.op_in_percent, input.seed, input.without};
  if (!varies(renewed.pv)) return std::nullopt;
  BaselineAnalysis analysis = analyse_baseline(input, at_rows, renewed.grid);
  if (!has_rows(analysis, kFewestRenewals)) return std::nullopt;
  const double error = analysis.error_of_both_halves();
  Explanation explanation = select_and_report(analysis);
  explanation.baseline.holdout_error = error;
  spread_over(explanation, share);
  hold.holdout_error_after = explanation.baseline.holdout_error;
  explanation.noise_floor = std::min(explanation.noise_floor, hold.holdout_error_after);
  explanation.baseline.holdout_error = hold.holdout_error_before;
  add_first(hold, explanation);
  return FittedLoop{std::move(explanation), std::move(samples.stepwise),
                    std::move(analysis.stepwise)};
}

/// pv is a function of op up to rounding: one of the two was computed from the other.
bool too_good(const BaselineAnalysis& analysis) {
  constexpr double kRounding = 1e-8;  // of pv's variance
  return analysis.stepwise.baseline.fit.score_error < kRounding;
}

Explanation refused(const BaselineAnalysis& analysis) {
  Explanation explanation = begin_explanation(analysis);
  explanation.noise_floor = analysis.baseline_error();
  explanation.excitation =
      "Not excited: op predicts pv up to rounding, as the controller run backwards does.";
  explanation.process_doubt = explanation.excitation;
  report_linear_rest(analysis, explanation);
  return explanation;
}

}  // namespace

std::optional<Explanation> explain(const ModelInput& input) {
  std::optional<FittedLoop> told = fit_loop_model(input);
  if (!told) return std::nullopt;
  return std::move(told->explanation);
}

std::optional<FittedLoop> fit_loop_model(const ModelInput& input) {
  constexpr std::size_t kFewestRows = 100;
  if (!fittable(input)) return std::nullopt;
  BaselineAnalysis analysis = analyse_baseline(input);
  if (!has_rows(analysis, kFewestRows)) return std::nullopt;
  if (too_good(analysis))
    return FittedLoop{refused(analysis), std::move(analysis.stepwise), std::nullopt};
  const SensorFinding sensor = find_sensor_steps(analysis.baseline_error(), analysis.answers);
  std::optional<FittedLoop> told;
  if (sensor.renewed()) told = tell_renewals(input, analysis, *sensor.hold, sensor.hold_samples);
  if (!told) {
    // Of a held sensor with few renewals nothing but the hold is claimed: samples in between follow
    // no loop.
    const bool linear_only = sensor.renewed() || rests(input.pv);
    Explanation explanation =
        linear_only ? report_linear_model(analysis) : select_and_report(analysis);
    told = FittedLoop{std::move(explanation), std::move(analysis.stepwise), std::nullopt};
    if (sensor.hold) add_first(*sensor.hold, told->explanation);
  }
  if (sensor.quantisation) add_first(*sensor.quantisation, told->explanation);
  return told;
}

}  // namespace loopscope::core::model
