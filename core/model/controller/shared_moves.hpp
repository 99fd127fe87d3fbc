#pragma once

#include <span>

namespace loopscope::core::model {

/// How much of one signal's moves another one's explain.
struct SharedMoves {
  double r_squared = 0.0;    ///< 0 to 1, at the time scale where it is most significant
  double chi_squared = 0.0;  ///< n R^2 there; three degrees of freedom when nothing is shared
  int scales = 0;            ///< time scales that were tried
};

/// Moves of `answer` from block to block on those of `cause` in the block before, the same and the
/// next, for blocks of 1, 2, 4, ... samples. Says nothing of which one leads. NaN = missing; both
/// equally long. All 0 with fewer than 24 moves.
[[nodiscard]] SharedMoves find_shared_moves(std::span<const double> cause,
                                            std::span<const double> answer);

}  // namespace loopscope::core::model
