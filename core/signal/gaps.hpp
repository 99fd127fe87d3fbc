#pragma once

#include <cstddef>

#include "core/signal/loop_window.hpp"

namespace loopscope::core::signal {

/// No quantity of a plant is larger in any unit: fourth powers of such values, summed over a
/// record, fit into a double.
inline constexpr double kLargestValue = 1e60;

/// Values beyond +-kLargestValue, infinite ones among them, become missing ones.
void discard_infinite(Samples& samples);

/// Bridges runs of at most `longest` missing samples between two recorded ones by a straight line.
/// Longer runs stay missing: a filled gap is phase-coupled to itself and raises the bicoherence.
void bridge_gaps(Samples& samples, std::size_t longest);

/// The same for values that are held until they change (setpoint): the last value goes on.
void hold_gaps(Samples& samples, std::size_t longest);

/// Number of recorded (finite) samples.
[[nodiscard]] std::size_t count_recorded(const Samples& samples);

}  // namespace loopscope::core::signal
