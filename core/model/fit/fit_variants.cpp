#include "core/model/fit/fit_variants.hpp"

#include <algorithm>

#include "core/model/effects/effect_catalogue.hpp"
#include "core/model/fit/added_column.hpp"
#include "core/model/fit/newton_step.hpp"
#include "core/model/response/whitening.hpp"

namespace loopscope::core::model {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Of the columns' products, pv's first: the sum of squares that the fit leaves.
double squares_left(const MatrixXd& normal) {
  const Index terms = normal.rows() - 1;
  const auto regressors = normal.bottomRightCorner(terms, terms);
  const VectorXd right = normal.col(0).tail(terms);
  const VectorXd coefficients = solve_normal(regressors, right);
  return normal(0, 0) + coefficients.dot(regressors * coefficients - 2.0 * right);
}

std::vector<ValveAndProcess> valves_among(std::span<const EffectPtr> effects,
                                          const ProcessShape& process) {
  std::vector<ValveAndProcess> valves;
  for (const EffectPtr& effect : effects) {
    if (const ValveEffect* valve = effect->as_valve()) valves.push_back({valve, &process});
  }
  return valves;
}

}  // namespace

FitVariants::FitVariants(const LoopData& data, const Structure& structure)
    : data_(data),
      structure_(structure),
      bends_(bends_flow(structure.effects.back()->kind())),
      flow_(data.op) {
  structure_.effects.pop_back();
  for (const EffectPtr& effect : structure_.effects) effect->shape_flow(flow_);
  std::vector<EffectPtr> steady = structure_.effects;
  if (bends_) {
    const auto moving = std::stable_partition(
        steady.begin(), steady.end(),
        [](const EffectPtr& effect) { return is_from_outside(effect->kind()); });
    following_.assign(moving, steady.end());
    steady.erase(moving, steady.end());
  } else {
    answered_ = answer(structure_.process, flow_);
  }
  steady_ = DesignMaker(data_, steady).make(structure_);
  steady_columns_ = steady_.columns();
  // The process's answer is one of the columns that move with the flow.
  if (bends_) {
    steady_columns_.erase(steady_columns_.begin() + 1, steady_columns_.begin() + 1 + steady_.taps);
  }
  steady_normal_ = products(steady_columns_, data_.rows.fit);
}

std::vector<Column> FitVariants::moved_columns(const Effect& last,
                                               const ProcessShape& process) const {
  std::vector<Column> columns;
  if (!bends_) {
    last.add_columns({flow_, answered_, process}, columns);
    return columns;
  }
  std::vector<double> flow = flow_;
  last.shape_flow(flow);
  Column response(flow.size());
  respond(process, flow, response);
  columns.push_back(std::move(response));
  if (following_.empty() && last.column_count() == 0) return columns;
  std::vector<double> answered = columns.front();
  weigh(process.numerator, answered);
  const Signals signals{flow, answered, process};
  for (const EffectPtr& effect : following_) effect->add_columns(signals, columns);
  last.add_columns(signals, columns);
  return columns;
}

MatrixXd FitVariants::whitened(std::vector<Column> columns) const {
  for (Column& signal : columns) keep_rows(data_.grid, signal);
  const bool second_tap = bends_ && structure_.two_taps;
  const auto count = static_cast<Index>(columns.size());
  MatrixXd table(static_cast<Index>(data_.size()), count + (second_tap ? 1 : 0));
  Whitening whitening;
  for (Index at = 0; at < count; ++at) {
    whitening.add(columns[static_cast<std::size_t>(at)], column(table, at));
  }
  whitening.run(structure_.noise);
  if (second_tap) put_later(column(table, 0), column(table, count));
  return table;
}

/// `moved`: products of the moved columns with the steady ones and with one another.
MatrixXd FitVariants::normal_with(const MatrixXd& moved) const {
  const Index count = moved.rows();
  const Index steady = steady_normal_.rows();
  MatrixXd normal(steady + count, steady + count);
  normal.topLeftCorner(steady, steady) = steady_normal_;
  normal.bottomRows(count) = moved;
  normal.topRightCorner(steady, count) = moved.leftCols(steady).transpose();
  return normal;
}

double FitVariants::error_of(const MatrixXd& moved) const {
  const std::size_t rows = data_.rows.fit_count();
  return rows == 0 ? 0.0 : squares_left(normal_with(moved)) / static_cast<double>(rows);
}

double FitVariants::fit_error(const EffectPtr& last) const {
  return fit_error(*last, structure_.process);
}

double FitVariants::fit_error(const Effect& last, const ProcessShape& process) const {
  const MatrixXd table = whitened(moved_columns(last, process));
  const std::vector<Signal> columns = columns_of(table);
  MatrixXd moved(table.cols(), steady_normal_.rows() + table.cols());
  moved.leftCols(steady_normal_.rows()) = products(columns, steady_columns_, data_.rows.fit);
  moved.rightCols(table.cols()) = products(columns, data_.rows.fit);
  return error_of(moved);
}

std::vector<double> FitVariants::fit_errors(std::span<const EffectPtr> lasts, Digits digits) const {
  const std::vector<ValveAndProcess> valves = valves_among(lasts, structure_.process);
  if (valves.size() == lasts.size()) return fit_errors(valves, digits);
  std::vector<double> errors;
  for (const EffectPtr& last : lasts) errors.push_back(fit_error(last));
  return errors;
}

std::vector<double> FitVariants::fit_errors(std::span<const ValveAndProcess> valves,
                                            Digits digits) const {
  std::vector<double> errors;
  if (!following_.empty() || !data_.grid.every_sample()) {
    for (const ValveAndProcess& one : valves) errors.push_back(fit_error(*one.valve, *one.process));
    return errors;
  }
  const ValveResponses answers(flow_, structure_, steady_columns_, data_.rows.fit);
  AddedColumn added(steady_normal_);
  const auto rows = static_cast<double>(data_.rows.fit_count());
  const bool ranked = digits == Digits::single && !structure_.two_taps && rows > 0.0;
  for (const MatrixXd& moved : answers.products(valves, digits)) {
    const std::span<const double> column(moved.data(), static_cast<std::size_t>(moved.size()));
    errors.push_back(ranked ? added.squares_left(column) / rows : error_of(moved));
  }
  return errors;
}

bool BestVariant::take(const FitVariants& variants, std::span<const EffectPtr> tried,
                       Digits digits) {
  const double rounding = digits == Digits::full ? 1e-9 : 1e-5;  // of an error
  const std::vector<double> errors = variants.fit_errors(tried, digits);
  std::size_t best = tried.size();
  double least = error;
  for (std::size_t i = 0; i < tried.size(); ++i) {
    if (!(errors[i] < (1.0 - rounding) * least)) continue;  // nor one that has overflown
    best = i;
    least = errors[i];
  }
  if (best == tried.size()) return false;
  if (digits == Digits::single) least = variants.fit_error(tried[best]);
  if (!(least < error)) return false;
  *this = {tried[best], least};
  return true;
}

}  // namespace loopscope::core::model
