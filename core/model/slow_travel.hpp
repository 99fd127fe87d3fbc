#pragma once

#include <optional>
#include <span>

#include "core/model/valve_law.hpp"

namespace loopscope::core::model {

/// Whether pv follows op's slow travel, or rests while op travels and then jumps.
///
/// Means of eight samples take the fast noise out; pv is fitted by a constant, a trend and a lag of
/// op, once of op itself and once of op behind Kano's valve for every band on a net. Blocks of six
/// means are fitted and scored by turns; shares are of pv's variance on the blocks held out.
struct SlowTravel {
  double linear_share = 0.0;  ///< explained by op
  double valve_share = 0.0;   ///< explained by op behind the valve
  double variance = 0.0;      ///< of the means, pv units squared
  double gain = 0.0;          ///< pv units per %, behind the valve
  Valve valve;

  [[nodiscard]] double error_before() const { return variance * (1.0 - linear_share); }
  [[nodiscard]] double error_after() const { return variance * (1.0 - valve_share); }
  /// A fifth of what op leaves, and a twelfth of all, has to be the valve's: curved trims and
  /// moving loads pass for a narrow band, but explain next to nothing by it.
  [[nodiscard]] bool sticks() const;
};

/// nullopt when fewer than 40 means, or no travel, are left. NaN = missing (the mean of what is
/// recorded; a line across longer gaps).
[[nodiscard]] std::optional<SlowTravel> judge_slow_travel(std::span<const double> pv,
                                                          std::span<const double> op);

}  // namespace loopscope::core::model
