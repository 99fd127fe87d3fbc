#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace loopscope::storage {

class Session;

/// The enabled loops of an area of the plant.
struct AreaFigures {
  std::string area;  ///< "" = the catalogue names none
  std::int64_t judged = 0;
  std::int64_t not_controlling = 0;  ///< no controller acts on them
  std::int64_t not_judged = 0;       ///< the newest window cannot be judged
  std::int64_t never_analysed = 0;
  double control_sum = 0.0;  ///< of the shares of their newest windows with a controller, 0 to 1
  std::int64_t control_loops = 0;  ///< loops of which that share is known
  /// Loops on the list, by their newest verdict, or, where that names no fault, by the one that
  /// brought them there.
  std::map<std::string, std::int64_t> flagged = {};
};

/// How the plant stands, for alarms: over all workers and hosts.
struct PlantFigures {
  std::vector<AreaFigures> areas;  ///< the largest first, at most kMostAreas and kOtherAreas
  /// Of each verdict of a fault: how often a loop came onto the list with it and listeners were
  /// told (table flag_total). Never less than it was.
  std::map<std::string, std::int64_t> announced;
};

/// Areas that are told apart: a catalogue may have as many as it has loops.
inline constexpr std::size_t kMostAreas = 20;
/// Those with the fewest loops, together.
inline constexpr const char* kOtherAreas = "other";

/// Asks in one statement and a transaction of its own (storage/MEASURED.md). The list is the one
/// that was announced last. Needs no right beyond the reader's. Throws DatabaseError.
[[nodiscard]] PlantFigures plant_figures(Session& session);

}  // namespace loopscope::storage
