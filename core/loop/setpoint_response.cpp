#include "core/loop/setpoint_response.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "core/hos/numeric/magnitude.hpp"

namespace loopscope::core::loop {
namespace {

using Eigen::Index;

/// Poles of a loop, its noise and a controller's filter; and moves that the loop may still answer.
constexpr Index kPast = 12;
constexpr Index kMoves = 41;
constexpr Index kColumns = kPast + kMoves + 1;
/// Rows per column below which the fit takes noise for an answer.
constexpr Index kFewestPerColumn = 6;

struct Series {
  Eigen::VectorXd error;      // about its mean, 0 = missing
  Eigen::VectorXd moves;      // of the setpoint, from sample to sample
  std::vector<Index> usable;  // samples whose past is recorded without a gap
};

Series series_of(const signal::Samples& error, const signal::Samples& sp) {
  Series series;
  const Index size = std::ssize(error);
  series.error = Eigen::VectorXd::Zero(size);
  series.moves = Eigen::VectorXd::Zero(size);
  const double mean = hos::finite_mean(error).mean;
  Index unbroken = 0;
  for (Index t = 0; t < size; ++t) {
    const auto n = static_cast<std::size_t>(t);
    unbroken = std::isfinite(error[n]) ? unbroken + 1 : 0;
    if (unbroken > 0) series.error[t] = error[n] - mean;
    if (t > 0 && std::isfinite(sp[n]) && std::isfinite(sp[n - 1])) {
      series.moves[t] = sp[n] - sp[n - 1];
    }
    if (unbroken > kPast && t >= kMoves) series.usable.push_back(t);
  }
  return series;
}

/// Past of `past`, newest first; moves of the setpoint, newest first; a constant.
Eigen::MatrixXd columns_of(const Series& series, const Eigen::VectorXd& past) {
  Eigen::MatrixXd columns(std::ssize(series.usable), kColumns);
  for (Index n = 0; n < columns.rows(); ++n) {
    const Index t = series.usable[static_cast<std::size_t>(n)];
    columns.row(n).head(kPast) = past.segment(t - kPast, kPast).reverse();
    columns.row(n).segment(kPast, kMoves) = series.moves.segment(t - kMoves + 1, kMoves).reverse();
    columns(n, kColumns - 1) = 1.0;
  }
  return columns;
}

/// What the model makes of the setpoint alone, from rest.
Eigen::VectorXd simulate(const Series& series, const Eigen::VectorXd& model) {
  const Index size = series.moves.size();
  Eigen::VectorXd moves = Eigen::VectorXd::Zero(kMoves + size);
  moves.tail(size) = series.moves;
  Eigen::VectorXd result = Eigen::VectorXd::Zero(kMoves + size);
  for (Index t = kMoves; t < result.size(); ++t) {
    result[t] = model.head(kPast).dot(result.segment(t - kPast, kPast).reverse()) +
                model.segment(kPast, kMoves).dot(moves.segment(t - kMoves + 1, kMoves).reverse());
  }
  return result.tail(size);
}

/// Mean square of the error without this answer; infinite for one that grows without bounds.
double left_of(const Series& series, const Eigen::VectorXd& answer) {
  if (!answer.allFinite()) return std::numeric_limits<double>::infinity();
  double sum = 0.0;
  for (const Index t : series.usable) {
    const double left = series.error[t] - answer[t];
    sum += left * left;
  }
  return sum / static_cast<double>(series.usable.size());
}

/// The one of three models that leaves least: of the moves alone; of moves and past by least
/// squares; and by instrumental variables, the best of the two as instrument. Moves alone cannot
/// grow without bounds, but forget a loop that rings for longer than they reach.
Eigen::VectorXd find_answer(const Series& series) {
  const Eigen::MatrixXd columns = columns_of(series, series.error);
  const Eigen::VectorXd target = series.error(series.usable);
  const auto moves = columns.rightCols(kMoves + 1);
  const Eigen::MatrixXd of_moves = moves.transpose() * moves;
  Eigen::VectorXd model = Eigen::VectorXd::Zero(kColumns);
  model.tail(kMoves + 1) = of_moves.ldlt().solve(moves.transpose() * target);
  Eigen::VectorXd best = simulate(series, model);
  const auto keep_better = [&series, &best](const Eigen::VectorXd& found) {
    const Eigen::VectorXd answer = simulate(series, found);
    if (left_of(series, answer) < left_of(series, best)) best = answer;
  };
  const Eigen::MatrixXd products = columns.transpose() * columns;
  keep_better(products.ldlt().solve(columns.transpose() * target));
  const Eigen::MatrixXd instruments = columns_of(series, best);
  const Eigen::MatrixXd crossed = instruments.transpose() * columns;
  keep_better(crossed.fullPivLu().solve(instruments.transpose() * target));
  return best;
}

}  // namespace

signal::Samples without_setpoint_response(const signal::Samples& error, const signal::Samples& sp) {
  if (sp.size() != error.size()) return {};
  const Series series = series_of(error, sp);
  if (std::ssize(series.usable) < kFewestPerColumn * kColumns) return {};
  if (!(series.moves.squaredNorm() > 0.0)) return {};
  const Eigen::VectorXd answer = find_answer(series);
  if (!(left_of(series, answer) < left_of(series, Eigen::VectorXd::Zero(answer.size())))) return {};
  signal::Samples left = error;
  for (std::size_t t = 0; t < left.size(); ++t) left[t] -= answer[static_cast<Index>(t)];
  return left;
}

}  // namespace loopscope::core::loop
