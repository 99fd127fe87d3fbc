#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "tests/plants/diagnosed_loop.hpp"

namespace loopscope::tests::plants {

/// How long a plant is watched: `windows` that share no sample, in slots of a tenth of a window.
struct Watch {
  std::size_t windows = 30;
  std::size_t onset_windows = 3;  ///< faults begin so long after the first slot
};

inline constexpr std::size_t kSlotsInWindow = 10;

/// One loop over all slots, judged as the daemon does: every slot by its window and those before.
struct WatchedLoop {
  std::vector<DiagnosedLoop> slots;  ///< by all windows
  /// Probability of a fault by the single window that holds nothing from before the onset, the
  /// first of them; nullopt = none was weighed, or the loop is healthy.
  std::optional<double> single_probability;
  /// Of each slot: the share of its samples with op at 0 or 100 %. Loads wander for so many windows
  /// that now and then one takes all of op.
  std::vector<double> at_limit;
  bool from_the_start = false;  ///< a tuning: there is no time before the fault
};

/// Of one sample a second, whatever the record's own interval: only samples count here.
[[nodiscard]] WatchedLoop watch_loop(const PlantLoop& loop, const Watch& watch);

}  // namespace loopscope::tests::plants
