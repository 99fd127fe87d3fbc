#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/plant/loop_records.hpp"
#include "core/plant/shared_oscillation.hpp"

namespace loopscope::core::plant {

/// One loop of an event.
struct EventMember {
  std::size_t index = 0;  ///< in the loops, or records, that were given
  double p = 1.0;         ///< Follower::p against the course of the others
  double strength = 0.0;  ///< share of the error's variance in the oscillation, 0 to 1
};

/// Loops that follow one course, as found from the records alone.
struct Event {
  double frequency_hz = 0.0;
  double p = 1.0;                    ///< as SharedOscillation::p
  std::vector<EventMember> members;  ///< in the order of their indices
};

/// Every event of the plant, strongest evidence first.
///
/// 1. Lines: every loop's spectral lines, faint ones too (spectral_line.hpp), strongest first.
/// 2. Who follows it: all loops against the line's loop at its frequency (following.hpp); the hub
///    that independent loops show least often (hub.hpp) has to be rarer than event_p.
/// 3. Members: who follows the common course of the hub, by false-discovery control.
/// 4. The line of all: loops of one process go together at rest as well, but over broad bands.
///    Their evidence for a line is added by Fisher's rule and has to be rarer than event_p as well.
/// A line that lies in an event of its loop, or at a harmonic of it, begins no other one; events of
/// one line that share most loops are one. Loops and settings are not checked here
/// (find_shared_oscillations() does).
[[nodiscard]] std::vector<Event> find_events(std::span<const LoopRecords> records,
                                             const PlantSettings& settings);
[[nodiscard]] std::vector<Event> find_events(std::span<const MemberLoop> loops,
                                             const PlantSettings& settings);

}  // namespace loopscope::core::plant
