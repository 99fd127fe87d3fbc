#include "core/signal/loop_prediction.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/signal/order/spread.hpp"

namespace loopscope::core::signal {
namespace {

constexpr std::size_t kOwnPast = 8;
constexpr std::size_t kInputPast = 15;
constexpr std::size_t kFewestRowsPerColumn = 4;

/// What is left of a column's squares, by its own, below which it is a sum of the columns before.
constexpr double kDependent = 1e-12;

bool moves(const Samples& series) {
  const std::optional<Spread> spread = measure_spread(series);
  return spread && !spread->constant();
}

double product(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// Takes of `from` what is along `column`, whose squares add up to `size`; returns how much.
double take_off(const std::vector<double>& column, double size, std::vector<double>& from) {
  if (size == 0.0) return 0.0;
  const double share = product(column, from) / size;
  for (std::size_t k = 0; k < from.size(); ++k) from[k] -= share * column[k];
  return share;
}

/// Weights of the columns that sum up to the target, by modified Gram and Schmidt; 0 for a column
/// that is a sum of those before.
std::vector<double> least_squares(std::vector<std::vector<double>> columns,
                                  std::vector<double> target) {
  const std::size_t n = columns.size();
  std::vector<double> sizes;
  std::vector<double> weights;
  std::vector<std::vector<double>> shares(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double before = product(columns[i], columns[i]);
    for (std::size_t j = 0; j < i; ++j)
      shares[i].push_back(take_off(columns[j], sizes[j], columns[i]));
    const double size = product(columns[i], columns[i]);
    sizes.push_back(size > kDependent * before ? size : 0.0);
    weights.push_back(take_off(columns[i], sizes[i], target));
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t j = 0; j < i; ++j) weights[j] -= shares[i][j] * weights[i];
  }
  return weights;
}

std::vector<std::vector<double>> transposed(const std::vector<std::vector<double>>& rows) {
  std::vector<std::vector<double>> columns(rows.front().size());
  for (const std::vector<double>& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) columns[i].push_back(row[i]);
  }
  return columns;
}

}  // namespace

LoopPrediction::LoopPrediction(const Samples& pv, const Samples& op, const Samples& sp,
                               const std::vector<bool>& suspect)
    : op_(op), sp_(sp), with_op_(moves(op)), with_sp_(moves(sp)) {
  const std::vector<Row> rows = rows_to_fit(pv, suspect);
  if (rows.empty() || rows.size() < kFewestRowsPerColumn * rows.front().size()) return;
  std::vector<std::vector<double>> columns = transposed(rows);
  std::vector<double> target = std::move(columns.back());
  columns.pop_back();
  weights_ = least_squares(std::move(columns), std::move(target));
}

double LoopPrediction::error(const Samples& pv, std::size_t k) const {
  Row values = k < kInputPast || weights_.empty() ? Row{} : row(pv, k);
  if (values.empty()) return kMissing;
  const double measured = values.back();
  values.pop_back();
  return measured - product(values, weights_);
}

/// What predicts sample k, and at the end the sample itself.
LoopPrediction::Row LoopPrediction::row(const Samples& pv, std::size_t k) const {
  Row values{1.0};
  for (std::size_t lag = 1; lag <= kOwnPast; ++lag) values.push_back(pv[k - lag]);
  for (std::size_t lag = 1; lag <= kInputPast && with_op_; ++lag) values.push_back(op_[k - lag]);
  for (std::size_t lag = 0; lag <= kInputPast && with_sp_; ++lag) values.push_back(sp_[k - lag]);
  values.push_back(pv[k]);
  return values;
}

std::vector<LoopPrediction::Row> LoopPrediction::rows_to_fit(
    const Samples& pv, const std::vector<bool>& suspect) const {
  std::vector<Row> rows;
  std::size_t since_suspect = kOwnPast + 1;
  for (std::size_t k = 0; k < pv.size(); ++k) {
    since_suspect = suspect[k] ? 0 : since_suspect + 1;
    if (since_suspect <= kOwnPast || k < kInputPast) continue;
    Row values = row(pv, k);
    const bool whole =
        std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
    if (whole) rows.push_back(std::move(values));
  }
  return rows;
}

}  // namespace loopscope::core::signal
