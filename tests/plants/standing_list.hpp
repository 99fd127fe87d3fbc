#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tests/plants/flags.hpp"
#include "tests/plants/watched_loop.hpp"

namespace loopscope::tests::plants {

/// How a list stands over time.
struct StandingList {
  std::size_t faults = 0;
  std::size_t listed = 0;             ///< faults that came onto the list at all
  std::size_t listed_as_another = 0;  ///< of those: with the verdict of another fault at first
  double entries_per_fault = 0.0;     ///< of those listed; one for a stay that the fault has met
  double false_entries = 0.0;  ///< entries of loops without a fault, per 1000 of their windows
  double false_entries_with_saturated = 0.0;  ///< those of `saturated` as well
  /// From the onset to the list, windows, of faults whose single window has a probability of at
  /// least 0.8 and that were not on the list before; nullopt = so many were never listed.
  std::optional<double> delay_windows, delay_windows_p90;
  std::size_t sure_faults = 0, sure_listed = 0;  ///< of such faults
  std::vector<std::string> wrong;                ///< each false entry in words
  /// Entries of loops without a fault whose load had driven op to its limit for a tenth of the
  /// window and more, and that say so as long as they last. A stay that goes on under another
  /// verdict (health included), or into a window that shares no sample with one at the limit, is
  /// false from then on.
  std::vector<std::string> saturated;
  std::vector<std::string> missed;  ///< faults that were never listed
  std::vector<std::string> right;   ///< faults that were, with their delay
};

/// The list of every slot in turn, its stays kept (flagged_after).
[[nodiscard]] StandingList run_list(const std::vector<PlantLoop>& plant,
                                    const std::vector<WatchedLoop>& watched, const Watch& watch,
                                    const FlagRule& rule = {});

[[nodiscard]] std::string json_of(const StandingList& list);

}  // namespace loopscope::tests::plants
