#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/signal/loop_window.hpp"

namespace loopscope::core::loop {

/// A value of the setpoint as pv's unit has it: offset + factor * sp.
struct UnitConversion {
  std::string words;  ///< behind a value of sp: "converted from degF to degC", "times 100"
  double factor = 1.0;
  double offset = 0.0;  ///< pv units
  double share = 0.0;   ///< of loops whose units differ, 0 to 1
};

/// The conversions that are looked for; percent of the transmitter's range only where that is
/// known.
[[nodiscard]] std::vector<UnitConversion> unit_conversions(
    const std::optional<signal::OpRange>& range);

/// Whether setpoint and pv are in different units.
struct UnitMatch {
  double probability = 0.0;   ///< that they are, in any of the units that were looked for, 0 to 1
  UnitConversion conversion;  ///< the likeliest
  double sp_mean = 0.0;
  double pv_mean = 0.0;
  double slope = 0.0;   ///< of pv over sp; 0 where sp does not move
  double offset = 0.0;  ///< of pv over sp: pv is nearly offset + slope * sp
  /// How far pv lies from that line, standard deviation of means over a thirty-second of the
  /// window.
  double residual = 0.0;
  bool follows = false;  ///< pv follows the setpoint's moves with the conversion's factor
};

/// Weighs that pv keeps to the converted setpoint against both that it keeps to the setpoint and
/// that it lies elsewhere: a controller without integral action, at its limit, or in manual. Both
/// of one length, NaN = missing; `range` is that of pv's transmitter. nullopt where less than half
/// of the window has both, and of sizes beyond 1e150.
[[nodiscard]] std::optional<UnitMatch> match_units(std::span<const double> sp,
                                                   std::span<const double> pv,
                                                   const std::optional<signal::OpRange>& range);

}  // namespace loopscope::core::loop
