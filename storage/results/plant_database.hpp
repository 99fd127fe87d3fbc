#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "storage/catalogue_entry.hpp"
#include "storage/connection_settings.hpp"
#include "storage/error.hpp"
#include "storage/results/announce_flags.hpp"
#include "storage/results/write_plant_round.hpp"

namespace loopscope::storage {

/// An enabled loop whose newest usable window oscillates.
struct OscillatingLoop {
  CatalogueEntry loop;
  std::int64_t slot_end_us = 0;
  std::int64_t window_start_us = 0, window_end_us = 0;  ///< first and last sample
  std::string code;                                     ///< verdict of that window
  double confidence = 0.0;
  double oscillation_period_s = 0.0;
  std::optional<double> nonlinear_p;
};

/// What one worker does for all loops together, on a connection of its own: a round over the plant,
/// and the announcement of flags. A worker's rights are enough. Not shared between threads. Every
/// function throws DatabaseError; after Remedy::reconnect the object must be thrown away.
class PlantDatabase {
 public:
  explicit PlantDatabase(const ConnectionSettings& settings);
  ~PlantDatabase();

  /// Whether a round is due (the last one was written `every_s` seconds ago or longer) and this
  /// object is the one to make it: no other one gets true while it lives.
  [[nodiscard]] bool claim_round(double every_s);
  /// The loops to compare, by name.
  [[nodiscard]] std::vector<OscillatingLoop> oscillating_loops();
  /// Writes a round in one transaction; repeating it after a commit in doubt is harmless.
  void write_round(const PlantRoundRecord& round);
  /// Notes what came onto the list and what left it, and tells listeners; whoever calls.
  FlagAnnouncement announce_flags();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace loopscope::storage
