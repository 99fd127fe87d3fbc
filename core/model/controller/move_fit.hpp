#pragma once

#include <array>
#include <bitset>
#include <cstddef>

#include "core/model/controller/controller_moves.hpp"

namespace loopscope::core::model {

/// The terms of a law that are fitted; the others are 0.
using Terms = std::bitset<kMoveTerms>;

/// Parts of the record whose disagreement gives the standard errors.
inline constexpr std::size_t kParts = 16;

using Square = Eigen::Matrix<double, kMoveTerms, kMoveTerms>;

/// Normal equations of some moves.
struct Sums {
  Square seen = Square::Zero();
  MoveVector cross = MoveVector::Zero();
  double op = 0.0;

  void add(const Move& move) {
    seen.noalias() += move.seen * move.seen.transpose();
    cross.noalias() += move.seen * move.op;
    op += move.op * move.op;
  }
  void add(const Sums& other, double sign) {
    seen += sign * other.seen;
    cross += sign * other.cross;
    op += sign * other.op;
  }
};

/// Least squares of all moves over some span (samples). Coefficients in % per unit of Move::seen;
/// `explained`: share of the squares of op's moves, up to 1.
struct MoveFit {
  std::size_t span = 1;
  std::ptrdiff_t lag = 0;
  std::size_t moves = 0;
  Sums all;
  std::array<Sums, kParts> parts{};
  MoveVector coefficients = MoveVector::Zero();
  double explained = 0.0;
  bool shows_integral = false;
};

/// With fewer than 64 moves there is no fit: `moves` is the number found, `explained` 0.
[[nodiscard]] MoveFit fit_moves(const ControllerMoves& recorded, std::size_t span,
                                std::ptrdiff_t lag, const Terms& terms);

/// The same moves on other terms.
void refit(MoveFit& fit, const Terms& terms);

/// Standard error of a coefficient, in its unit: the fits that leave one part out (jackknife).
[[nodiscard]] double standard_error(const MoveFit& fit, const Terms& terms, int term);

/// The term makes more than 1e-4 of op's squares, and is more than four standard errors from zero.
[[nodiscard]] bool counts(const MoveFit& fit, const Terms& terms, int term);

}  // namespace loopscope::core::model
