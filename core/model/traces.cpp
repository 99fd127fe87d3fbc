#include "core/model/traces.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

#include "core/model/display_window.hpp"
#include "core/model/explain.hpp"
#include "core/model/fit/simulation_error.hpp"
#include "core/model/limit_cycle/limit_cycle_simulation.hpp"
#include "core/signal/loop_window.hpp"

namespace loopscope::core::model {
namespace {

template <class Value>
void mark(const std::vector<Range>& ranges, const std::vector<Value>& from,
          std::vector<Value>& to) {
  for (const Range& range : ranges) {
    for (std::size_t row = range.first; row < range.end; ++row) to[row] = from[row];
  }
}

/// By row, scaled: the error of the fit that has not seen it. Where both have, or neither was
/// scored, that of the first.
std::vector<double> unseen_errors(const Judged& judged) {
  std::vector<double> errors = judged.fit.fit.innovations;
  mark(judged.rows.fit, judged.fit.other_fold.innovations, errors);
  mark(judged.rows.score, judged.fit.fit.innovations, errors);
  return errors;
}

std::vector<bool> judged_rows(const Judged& judged, std::size_t rows) {
  const std::vector<bool> all(rows, true);
  std::vector<bool> result(rows, false);
  mark(judged.rows.score, all, result);
  if (!judged.once) mark(judged.rows.fit, all, result);
  return result;
}

/// By row, pv units.
std::vector<double> simulated_rows(const LoopData& data, const Fit& fit) {
  std::vector<double> result = simulation_residual(data, fit);
  for (std::size_t row = 0; row < result.size(); ++row)
    result[row] = data.pv_mean + data.pv_scale * (data.pv[row] - result[row]);
  return result;
}

/// `put(row, sample)` for each sample from a row up to the next one, of rows that count and, once
/// the filters have forgotten what was before the record, of all.
template <class Put>
void for_each_sample(const LoopData& data, const std::vector<bool>& counts, Put put) {
  const std::size_t warm_up = warm_up_rows(data.grid, data.size());
  for (std::size_t row = 0; row < data.size(); ++row) {
    if (row < warm_up && !counts[row]) continue;
    const std::size_t end = std::min(data.samples(), data.grid.sample_of(row + 1));
    for (std::size_t k = data.grid.sample_of(row); k < end; ++k) put(row, k);
  }
}

double mean_square(const std::vector<double>& values, const std::vector<bool>& counts) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!counts[k]) continue;
    sum += values[k] * values[k];
    ++count;
  }
  return count == 0 ? signal::kMissing : sum / static_cast<double>(count);
}

/// The series of a fit as it was judged, no effect named yet. `data`: what was modelled, whatever
/// its rows; `measured`: a value for each of its samples, pv units, NaN = missing.
TraceStage judged_stage(std::span<const double> measured, LoopData data, const Judged& judged) {
  data.rows = judged.rows;
  const std::vector<double> none(measured.size(), signal::kMissing);
  TraceStage stage{{}, none, none, none, std::vector<bool>(measured.size(), false), 0.0, 0.0};
  const std::vector<double> errors = unseen_errors(judged);
  const std::vector<double> simulated = simulated_rows(data, judged.fit.fit);
  const std::vector<bool> counts = judged_rows(judged, data.size());
  for_each_sample(data, counts, [&](std::size_t row, std::size_t k) {
    const bool at_row = k == data.grid.sample_of(row);
    const double error = at_row ? data.pv_scale * errors[row] : 0.0;
    stage.one_step_prediction[k] = measured[k] - error;
    stage.one_step_residual[k] = at_row && std::isnan(measured[k]) ? signal::kMissing : error;
    stage.simulated[k] = simulated[row];
    stage.held_out[k] = counts[row] && !std::isnan(measured[data.grid.sample_of(row)]);
  });
  stage.one_step_error = mean_square(stage.one_step_residual, stage.held_out);
  stage.simulation_error = simulation_error(data, judged.fit.fit) * data.pv_scale * data.pv_scale;
  return stage;
}

TraceStage named(TraceStage stage, EffectKind effect) {
  stage.effect = effect;
  return stage;
}

bool is_of_the_sensor(EffectKind effect) {
  return effect == EffectKind::sensor_quantisation || effect == EffectKind::sensor_hold;
}

/// measured less simulated.
std::vector<double> differences(std::span<const double> measured,
                                const std::vector<double>& simulated) {
  std::vector<double> result(measured.size());
  std::ranges::transform(measured, simulated, result.begin(), std::minus<>());
  return result;
}

double mean_square(const std::vector<double>& values) {
  double sum = 0.0, count = 0.0;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    sum += value * value;
    count += 1.0;
  }
  return count > 0.0 ? sum / count : signal::kMissing;
}

void put_simulation(std::span<const double> measured, std::vector<double> simulated,
                    TraceStage& stage) {
  stage.simulation_error = mean_square(differences(measured, simulated));
  stage.simulated = std::move(simulated);
}

class Stages {
 public:
  Stages(const ModelInput& input, const FittedLoop& told)
      : input_(input), told_(told), stepwise_(told.renewals ? *told.renewals : told.samples) {
    stages_.push_back(baseline(told.samples, true));
    const bool by_witness = told.explanation.error_kind == ErrorKind::simulation;
    if (by_witness) witness_ = simulate_limit_cycle(input, told.explanation.steps.back());
    if (witness_) put_simulation(input.pv, witness_->linear, stages_.front());
    for (const Step& step : told.explanation.steps)
      stages_.push_back(named(after(step, by_witness), step.effect));
  }
  [[nodiscard]] std::vector<TraceStage> take() { return std::move(stages_); }

 private:
  [[nodiscard]] TraceStage baseline(const StepwiseModel& stepwise, bool once) const {
    return judged_stage(input_.pv, stepwise.data, {stepwise.baseline, stepwise.first_rows, once});
  }

  [[nodiscard]] TraceStage after(const Step& step, bool by_witness) {
    const bool held = step.effect == EffectKind::sensor_hold;
    if (held && told_.renewals) return baseline(*told_.renewals, false);
    if (is_of_the_sensor(step.effect)) return stages_.back();
    if (by_witness) return seen_by_witness();
    return judged_stage(input_.pv, stepwise_.data, stepwise_.selected[next_++].judged);
  }

  [[nodiscard]] TraceStage seen_by_witness() const {
    TraceStage stage;
    stage.one_step_error = stage.simulation_error = signal::kMissing;
    if (witness_) put_simulation(input_.pv, witness_->valve, stage);
    return stage;
  }

  const ModelInput& input_;
  const FittedLoop& told_;
  const StepwiseModel& stepwise_;  ///< the one with selected effects
  std::optional<WitnessSimulation> witness_;
  std::vector<TraceStage> stages_;
  std::size_t next_ = 0;
};

std::vector<double> errors_of(std::span<const double> measured, const TraceStage& stage,
                              bool simulated) {
  return simulated ? differences(measured, stage.simulated) : stage.one_step_residual;
}

/// What one stage takes off the squared error of another; by simulation where that is all it has.
std::vector<double> gain_of(std::span<const double> measured, const TraceStage& before,
                            const TraceStage& after) {
  const bool simulated = after.one_step_residual.empty();
  if (simulated && after.simulated.empty()) return std::vector<double>(measured.size(), 0.0);
  const std::vector<double> old = errors_of(measured, before, simulated);
  std::vector<double> gain = errors_of(measured, after, simulated);
  std::ranges::transform(old, gain, gain.begin(), [](double a, double b) { return a * a - b * b; });
  return gain;
}

/// Of the first stage that changes the model.
std::vector<double> first_gain(const ExplanationTraces& traces) {
  const auto changed = std::ranges::adjacent_find(traces.stages, [](const auto& a, const auto& b) {
    return a.one_step_error != b.one_step_error;  // NaN of a stage by simulation differs
  });
  if (changed == traces.stages.end()) return std::vector<double>(traces.measured.size(), 0.0);
  return gain_of(traces.measured, *changed, *(changed + 1));
}

}  // namespace

std::optional<ExplanationTraces> trace_explanation(const ModelInput& input) {
  constexpr std::size_t kFewestRenewals = 60;  // in a picture
  std::optional<FittedLoop> told = fit_loop_model(input);
  if (!told) return std::nullopt;
  ExplanationTraces traces;
  traces.measured.assign(input.pv.begin(), input.pv.end());
  traces.stages = Stages(input, *told).take();
  const std::size_t fewest =
      told->renewals ? kFewestRenewals * told->renewals->data.grid.samples_per_row : 0;
  const Range stretch = telling_stretch(input.op, first_gain(traces), fewest);
  traces.telling_from = stretch.first;
  traces.telling_samples = stretch.size();
  traces.explanation = std::move(told->explanation);
  return traces;
}

}  // namespace loopscope::core::model
