#pragma once

#include <span>
#include <vector>

#include "core/diagnosis/odds/log_odds.hpp"
#include "core/diagnosis/verdicts/verdict.hpp"

namespace loopscope::core::diagnosis {

/// What becomes of a cause's log odds beside the others: scale * log odds + offset + the weight
/// that `rival` has at the log odds that any other cause is there + that of `nonlinear` at the log
/// odds that valve or process is nonlinear at all. What another cause explains needs no second one,
/// and what is nonlinear needs a cause that is (explaining away; Wellman and Henrion 1993).
struct ExplainingAway {
  double scale = 1.0;
  double offset = 0.0;
  std::vector<CurvePoint> rival;      ///< empty = this one stands alone, and is nobody's rival
  std::vector<CurvePoint> nonlinear;  ///< empty with `rival`
};

/// A cause by its own figures.
struct OwnOdds {
  VerdictCode code = VerdictCode::healthy;
  double log_odds = 0.0;  ///< by the plant's prior
  const ExplainingAway* beside = nullptr;
};

/// What others add to the log odds of a cause.
struct OthersPart {
  double weight = 0.0;       ///< log odds
  double probability = 0.0;  ///< that any other is there; that something is nonlinear
  VerdictCode first = VerdictCode::healthy;  ///< the most probable; nonlinear_unexplained
};

/// Of the cause at `place`, by the odds of all: rivals first, then any nonlinearity, where they are
/// among `all`. Empty where it stands alone.
[[nodiscard]] std::vector<OthersPart> parts_of_others(std::size_t place,
                                                      std::span<const OwnOdds> all);

/// Log odds of the cause at `place` beside the others; `log_odds`: by itself, by the prior of the
/// fit.
[[nodiscard]] double explaining_away(double log_odds, std::size_t place,
                                     std::span<const OwnOdds> all);

}  // namespace loopscope::core::diagnosis
