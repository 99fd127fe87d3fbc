#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/model/limit_cycle/travel_fit.hpp"
#include "core/model/valve_law/valve_law.hpp"

namespace loopscope::core::model {

/// The law that valves are tried by.
inline constexpr ValveLaw kTravelLaw = ValveLaw::kano;
/// Samples that are averaged to one.
inline constexpr std::size_t kTravelMean = 8;

/// Whether pv follows op's slow travel, or rests while op travels and then jumps.
///
/// Means of eight samples take the fast noise out; pv is fitted by a constant, a trend and a lag of
/// op, once of op itself and once of op behind Kano's valve for every band on a net. Blocks of six
/// means are fitted and scored by turns; shares are of pv's variance on the blocks held out, up to
/// 1, below 0 where a model is worse than the mean.
struct SlowTravel {
  double linear_share = 0.0;  ///< explained by op
  double valve_share = 0.0;   ///< explained by op behind the valve
  double variance = 0.0;      ///< of the means, pv units squared
  double level = 0.0;         ///< pv units; the models give pv less that
  TravelModel linear_model;   ///< of op
  TravelModel valve_model;    ///< of op behind `valve`
  Valve valve;

  [[nodiscard]] double error_before() const { return variance * (1.0 - linear_share); }
  [[nodiscard]] double error_after() const { return variance * (1.0 - valve_share); }
  /// The valve takes at least two fifths of what op leaves, and 4 % of pv's variance: curved trims
  /// and moving loads pass for a narrow band, but explain next to nothing by it.
  [[nodiscard]] bool sticks() const;
};

/// nullopt when fewer than 40 means, or no travel, are left. NaN = missing (the mean of what is
/// recorded; a line across longer gaps).
[[nodiscard]] std::optional<SlowTravel> judge_slow_travel(std::span<const double> pv,
                                                          std::span<const double> op);

/// pv by means, pv units, as op alone gives it, and as op behind the valve does; of the op that was
/// judged.
struct SimulatedTravel {
  std::vector<double> linear;
  std::vector<double> valve;
};
[[nodiscard]] SimulatedTravel simulate_travel(const SlowTravel& travel, std::span<const double> op);

}  // namespace loopscope::core::model
