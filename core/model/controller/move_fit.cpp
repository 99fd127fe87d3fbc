#include "core/model/controller/move_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace loopscope::core::model {
namespace {

/// Four moves for each part, so that leaving one out leaves a fit.
constexpr std::size_t kLeastFittedMoves = 4 * kParts;
/// A term counts when it stands this many standard errors from zero in sixteen parts (p about
/// 0.001) and moves op by more than rounding could.
constexpr double kSignificantErrors = 4.0;
constexpr double kLeastContribution = 1e-4;

/// Coefficients of `terms`; the others are 0.
MoveVector solve(Sums sums, const Terms& terms) {
  for (int i = 0; i < kMoveTerms; ++i) {
    if (terms[static_cast<std::size_t>(i)] && sums.seen(i, i) > 0.0) continue;
    sums.seen.row(i).setZero();
    sums.seen.col(i).setZero();
    sums.seen(i, i) = 1.0;
    sums.cross[i] = 0.0;
  }
  const MoveVector scale = sums.seen.diagonal().cwiseSqrt();
  const Square scaled =
      scale.cwiseInverse().asDiagonal() * sums.seen * scale.cwiseInverse().asDiagonal();
  return scaled.ldlt().solve(sums.cross.cwiseQuotient(scale)).cwiseQuotient(scale);
}

double left_over(const Sums& sums, const MoveVector& c) {
  return std::max(0.0, sums.op - 2.0 * c.dot(sums.cross) + c.dot(sums.seen * c));
}

}  // namespace

void refit(MoveFit& fit, const Terms& terms) {
  fit.coefficients = solve(fit.all, terms);
  fit.explained = fit.all.op > 0.0 ? 1.0 - left_over(fit.all, fit.coefficients) / fit.all.op : 0.0;
}

MoveFit fit_moves(const ControllerMoves& recorded, std::size_t span, std::ptrdiff_t lag,
                  const Terms& terms) {
  MoveFit fit;
  fit.span = span;
  fit.lag = lag;
  const double parts_per_sample =
      static_cast<double>(kParts) / static_cast<double>(recorded.size());
  recorded.visit(span, lag, [&](const Move& move) {
    fit.parts[static_cast<std::size_t>(static_cast<double>(move.at) * parts_per_sample)].add(move);
    ++fit.moves;
  });
  if (fit.moves < kLeastFittedMoves) return fit;
  for (const Sums& part : fit.parts) fit.all.add(part, 1.0);
  refit(fit, terms);
  return fit;
}

double standard_error(const MoveFit& fit, const Terms& terms, int term) {
  double sum = 0.0, squares = 0.0;
  for (const Sums& part : fit.parts) {
    Sums rest = fit.all;
    rest.add(part, -1.0);
    const double c = solve(rest, terms)[term] - fit.coefficients[term];
    sum += c / kParts;
    squares += c * c / kParts;
  }
  return std::sqrt((kParts - 1.0) * std::max(0.0, squares - sum * sum));
}

bool counts(const MoveFit& fit, const Terms& terms, int term) {
  const double c = fit.coefficients[term];
  return c * c * fit.all.seen(term, term) > kLeastContribution * fit.all.op &&
         std::abs(c) > kSignificantErrors * standard_error(fit, terms, term);
}

}  // namespace loopscope::core::model
