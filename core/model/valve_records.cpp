#include "core/model/valve_records.hpp"

#include <algorithm>
#include <cmath>

#include "core/model/lagged_rows.hpp"

namespace loopscope::core::model {
namespace {

/// Enough for twenty cycles of fifty rows; the first look costs a third of the whole record's.
constexpr std::size_t kQuickRows = 2048;
/// A value held no longer than this is as good as known: valves move little meanwhile.
constexpr std::size_t kLongestHold = 3;
/// Of op's span: half the smallest band that is looked at.
constexpr double kSmallestSwing = 0.015;

/// `op` with every NaN replaced by the value before it; the first ones by the first value.
std::vector<double> held(std::span<const double> op, std::vector<std::uint8_t>& known) {
  std::vector<double> result(op.begin(), op.end());
  known.assign(op.size(), 1);
  const auto first = std::ranges::find_if(op, [](double v) { return !std::isnan(v); });
  double last = first == op.end() ? 0.0 : *first;
  std::size_t age = kLongestHold;
  for (std::size_t k = 0; k < op.size(); ++k) {
    const bool missing = std::isnan(op[k]);
    age = missing ? age + 1 : 0;
    known[k] = age <= kLongestHold ? 1 : 0;
    last = missing ? last : op[k];
    result[k] = last;
  }
  return result;
}

std::vector<double> means(std::span<const double> values, std::size_t samples) {
  std::vector<double> result(values.size() / samples);
  for (std::size_t k = 0; k < result.size(); ++k) {
    double sum = 0.0;
    for (const double value : values.subspan(k * samples, samples)) {
      sum += value;
    }
    result[k] = sum / static_cast<double>(samples);
  }
  return result;
}

}  // namespace

ValveRecords::ValveRecords(const ValveSearchInput& input)
    : input_(input), op_(held(input.op, op_known_)) {
  for (const double value : op_) {
    op_level_ += value / static_cast<double>(op_.size());
  }
  for (double& value : op_) {
    value -= op_level_;
  }
  const auto [low, high] = std::ranges::minmax(op_);
  op_span_ = high - low;
  swings_.emplace(op_, kSmallestSwing * op_span_);
}

ValveRecords::Entry ValveRecords::make(std::size_t first, std::size_t count,
                                       std::size_t samples_per_row) const {
  Entry entry;
  const auto op = std::span(op_).subspan(first, count);
  entry.samples = count;
  entry.samples_per_row = samples_per_row;
  entry.record.rows = lagged_rows(input_.pv.subspan(first, count), input_.fit.subspan(first, count),
                                  std::span(op_known_).subspan(first, count), samples_per_row);
  entry.record.op.assign(op.begin(), op.end());
  entry.record.steps = op_steps(op);
  entry.record.steps_per_row = samples_per_row;
  entry.record.linear = fit_lagged(entry.record.rows, means(op, samples_per_row));
  entry.record.linear_residual = entry.record.linear.residual;
  entry.model = entry.record.linear;
  return entry;
}

std::size_t ValveRecords::best_stretch(std::size_t count) const {
  std::size_t best = 0;
  std::size_t most = 0;
  for (std::size_t first = 0; first + count <= op_.size();
       first += std::max<std::size_t>(1, count / 2)) {
    std::size_t usable = 0;
    for (std::size_t k = first; k < first + count; ++k) {
      usable += input_.fit[k] != 0 && op_known_[k] != 0 && !std::isnan(input_.pv[k]) ? 1U : 0U;
    }
    if (usable > most) {
      most = usable;
      best = first;
    }
  }
  return best;
}

ValveRecords::Entry& ValveRecords::full(std::size_t samples_per_row) {
  const auto found = full_.find(samples_per_row);
  return found != full_.end()
             ? found->second
             : full_.emplace(samples_per_row, make(0, op_.size(), samples_per_row)).first->second;
}

ValveRecords::Entry& ValveRecords::quick(std::size_t samples_per_row) {
  const auto found = quick_.find(samples_per_row);
  if (found != quick_.end()) {
    return found->second;
  }
  const std::size_t count = std::min(op_.size(), kQuickRows * samples_per_row);
  return quick_.emplace(samples_per_row, make(best_stretch(count), count, samples_per_row))
      .first->second;
}

}  // namespace loopscope::core::model
