#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "config/settings.hpp"
#include "core/plant/packed_error.hpp"
#include "core/signal/loop_window.hpp"
#include "daemon/service/shared/shared_services.hpp"
#include "storage/results/plant/plant_candidates.hpp"

namespace loopscope::daemon {

/// What the comparison of all loops takes from one window, made ready as for the analysis. Equal
/// lengths but for what was not asked for, which is empty; all empty = the historian no longer has
/// the rows.
struct PlantSeries {
  double sample_interval_s = 1.0;
  std::int64_t start_us = 0;    ///< of the first sample, microseconds UTC since 1970
  core::signal::Samples error;  ///< sp - pv, pv units; NaN = missing, as in the others
  core::plant::ErrorAbout about = core::plant::ErrorAbout::setpoint;
  core::signal::Samples sp;  ///< pv units; empty = not recorded, or it never moves
  core::signal::Samples pv;
  core::signal::Samples op;  ///< %, or op units; empty = not recorded
};

/// How much of a loop is wanted.
struct SeriesWanted {
  std::size_t windows = 1;  ///< >= 1: so many windows' time
  std::size_t of = 1;       ///< >= 1: as means of so many samples
  bool error_only = true;   ///< 33 kB a loop instead of 130
  /// Of every wanted loop, where it is not that of its slot; microseconds UTC since 1970.
  std::span<const std::int64_t> ends_us = {};
};

/// What was read of wanted[k]; called with a core's permit, for every k once at most.
using TakeSeries = std::function<void(std::size_t k, PlantSeries&& series)>;

/// Reads windows of `wanted` (indices of candidates) again, the newest where `how` does not say
/// another end, a batch of one historian at
/// a time, but for rows that the daemon has kept (`tools.windows`), as they were at its last visit.
/// False = it stopped early, since the process shall end. Throws storage::DatabaseError when a
/// historian is away, Failure when the settings have no such source.
[[nodiscard]] bool read_plant_series(std::span<const storage::PlantCandidate> candidates,
                                     std::span<const std::size_t> wanted, SeriesWanted how,
                                     const config::Settings& settings, SharedServices& tools,
                                     const TakeSeries& take);

}  // namespace loopscope::daemon
