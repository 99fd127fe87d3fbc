#include "core/model/fit_variants.hpp"

#include <algorithm>

#include "core/model/newton_step.hpp"
#include "core/model/whitening.hpp"

namespace loopscope::core::model {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Columns of time alone, whatever op does.
bool goes_by_time(const EffectPtr& effect) {
  return effect->kind() == EffectKind::load_step ||
         effect->kind() == EffectKind::external_oscillation;
}

/// Of the columns' products, pv's first: the sum of squares that the fit leaves.
double squares_left(const MatrixXd& normal) {
  const Index terms = normal.rows() - 1;
  const auto regressors = normal.bottomRightCorner(terms, terms);
  const VectorXd right = normal.col(0).tail(terms);
  const VectorXd coefficients = solve_normal(regressors, right);
  return normal(0, 0) + coefficients.dot(regressors * coefficients - 2.0 * right);
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
    const auto moving = std::ranges::stable_partition(steady, goes_by_time);
    following_.assign(moving.begin(), moving.end());
    steady.erase(moving.begin(), moving.end());
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

std::vector<Column> FitVariants::moved_columns(const EffectPtr& last) const {
  std::vector<Column> columns;
  if (!bends_) {
    last->add_columns({flow_, answered_, structure_.process}, columns);
    return columns;
  }
  std::vector<double> flow = flow_;
  last->shape_flow(flow);
  Column response(flow.size());
  respond(structure_.process, flow, response);
  columns.push_back(std::move(response));
  if (following_.empty() && last->column_count() == 0) return columns;
  std::vector<double> answered = columns.front();
  weigh(structure_.process.numerator, answered);
  const Signals signals{flow, answered, structure_.process};
  for (const EffectPtr& effect : following_) effect->add_columns(signals, columns);
  last->add_columns(signals, columns);
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

MatrixXd FitVariants::normal_with(const std::vector<Signal>& moved) const {
  const auto count = static_cast<Index>(moved.size());
  const Index steady = steady_normal_.rows();
  MatrixXd normal(steady + count, steady + count);
  normal.topLeftCorner(steady, steady) = steady_normal_;
  normal.bottomLeftCorner(count, steady) = products(moved, steady_columns_, data_.rows.fit);
  normal.topRightCorner(steady, count) = normal.bottomLeftCorner(count, steady).transpose();
  normal.bottomRightCorner(count, count) = products(moved, data_.rows.fit);
  return normal;
}

double FitVariants::fit_error(const EffectPtr& last) const {
  const MatrixXd table = whitened(moved_columns(last));
  const std::size_t rows = data_.rows.fit_count();
  if (rows == 0) return 0.0;
  return squares_left(normal_with(columns_of(table))) / static_cast<double>(rows);
}

bool BestVariant::take(const FitVariants& variants, const EffectPtr& tried) {
  constexpr double kRounding = 1e-9;  // of an error
  const double tried_error = variants.fit_error(tried);
  if (tried_error >= (1.0 - kRounding) * error) return false;
  *this = {tried, tried_error};
  return true;
}

Fit evaluated_with(const LoopData& data, Structure structure, const EffectPtr& last) {
  structure.effects.back() = last;
  return evaluate(data, structure);
}

}  // namespace loopscope::core::model
