#include "core/model/held_out_series.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/model/fit/simulation_error.hpp"
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

}  // namespace

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

}  // namespace loopscope::core::model
