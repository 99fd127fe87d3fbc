#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "storage/connection_settings.hpp"
#include "storage/error.hpp"
#include "storage/results/announce_flags.hpp"
#include "storage/results/plant_candidates.hpp"
#include "storage/results/write_plant_round.hpp"
#include "storage/server_clock.hpp"

namespace loopscope::storage {

/// Whose turn the comparison of all loops is. One object = one connection, which holds the turn
/// until the object ends: a worker that dies gives it back with its connection. Every function
/// throws DatabaseError; after Remedy::reconnect the object must be thrown away.
class PlantRounds {
 public:
  /// Connects and checks that the schema has the version this program was built for. Turns, rounds
  /// and announcements ask `check` first, as in ResultsDatabase.
  explicit PlantRounds(const ConnectionSettings& settings, ClockCheck check = {});
  ~PlantRounds();

  /// Seconds until the next round is due, by the database's clock: `every_s` after the last one was
  /// stored; 0 = now, and this object has the turn; nullopt = another worker is at it, or no loop
  /// was analysed yet.
  [[nodiscard]] std::optional<double> take_turn(double every_s);
  /// The newest slot of all loops: what a round is about. nullopt = no loop was analysed yet.
  [[nodiscard]] std::optional<std::int64_t> newest_slot_us();
  /// As plant_candidates(), for a round about that slot.
  [[nodiscard]] std::vector<PlantCandidate> candidates(std::int64_t slot_end_us,
                                                       std::int64_t limit);
  /// As write_plant_round().
  void store(const PlantRoundRecord& round);
  /// As announce_flags(), with or without the turn.
  FlagAnnouncement announce_flags();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace loopscope::storage
