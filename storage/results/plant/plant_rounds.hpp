#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "storage/connection_settings.hpp"
#include "storage/error.hpp"
#include "storage/results/plant/announce_flags.hpp"
#include "storage/results/plant/plant_candidates.hpp"
#include "storage/results/plant/write_plant_round.hpp"
#include "storage/server_clock.hpp"

namespace loopscope::storage {

/// Whether a round is to be made now, and by whom.
struct PlantTurn {
  /// Seconds until the next round is due, by the database's clock; 0 = now, and the turn is the
  /// asker's; nullopt = another worker is at it, or no loop was analysed yet.
  std::optional<double> wait_s;
  std::string holder;  ///< the other worker that has the turn; empty = none has
};

/// Whose turn the comparison of all loops is: a lease in the table task_lease, which an object
/// gives back when its round is stored, or it ends; that of a worker which dies runs out. Two that
/// make a round at once, because it took longer than the lease, do some work twice, nothing else.
/// One object = one connection; not shared between threads. Every function throws DatabaseError;
/// after Remedy::reconnect the object must be thrown away.
class PlantRounds {
 public:
  /// Connects and checks that the schema has the version this program was built for. Turns, rounds
  /// and announcements ask `check` first, as in ResultsDatabase.
  explicit PlantRounds(const ConnectionSettings& settings, ClockCheck check = {});
  ~PlantRounds();

  /// Whether the connection still answers: one that has rested may have been ended.
  [[nodiscard]] bool answers();

  /// Takes the turn for `owner` (host/pid) if a round is due, `every_s` after the last one was
  /// stored, and holds it for `hold_s`, 1 to 86400.
  [[nodiscard]] PlantTurn take_turn(double every_s, const std::string& owner, double hold_s);
  /// Leaves the turn to others where it is held: a round has come to nothing. What goes wrong with
  /// it is not said: the lease ends by itself.
  void give_turn_back() noexcept;
  /// The newest slot of all enabled loops that is not after now(), microseconds UTC: what a round
  /// is about. nullopt = no loop was analysed yet.
  [[nodiscard]] std::optional<std::int64_t> newest_slot_us();
  /// As plant_candidates(), for a round about that slot.
  [[nodiscard]] std::vector<PlantCandidate> candidates(std::int64_t slot_end_us,
                                                       std::int64_t limit);
  /// As write_plant_round(); gives the turn back.
  void store(const PlantRoundRecord& round);
  /// As announce_flags(), with or without the turn.
  FlagAnnouncement announce_flags();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace loopscope::storage
