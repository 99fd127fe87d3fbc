#pragma once

#include <optional>
#include <span>

namespace loopscope::core::loop {

/// The mv-op plot: what the valve does with what it is told, behind the delay and the lag of its
/// actuator (actuator.hpp).
struct ValvePlot {
  /// Mean width in op between the branch on which mv rises and the one on which it falls, at the
  /// same mv (at any mv where they share none), in units of op: the dead band, or stickband less
  /// slip jump (S - J) of a sticking valve. nullopt when mv moves in one direction only.
  std::optional<double> width;
  /// Mean move of mv in excess of op's own move at the first sample after a rest, >= 0: the slip
  /// jump of a sticking valve, none for a dead band. nullopt when mv never leaves a rest.
  std::optional<double> slip_jump;
  /// Share of the samples with op moving in which mv stands still, 0 to 1.
  std::optional<double> stuck_fraction;
};

/// `op` and `mv` (NaN = missing) have one unit, % of the range. No figures when either is constant
/// or empty, or their lengths differ.
[[nodiscard]] ValvePlot measure_valve_plot(std::span<const double> op, std::span<const double> mv);

}  // namespace loopscope::core::loop
