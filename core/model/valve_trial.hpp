#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "core/model/valve_records.hpp"
#include "core/model/valve_tracking.hpp"

namespace loopscope::core::model {

/// A valve that was tried, and how well it explains the record.
struct Trial {
  Valve valve;
  std::size_t samples_per_row = 1;
  double evidence = kNoEvidence;  ///< of the whole record, extrapolated from what was covered
  TrackedValve tracked;

  static constexpr double kNoEvidence = -1e300;
};

[[nodiscard]] inline bool better(const Trial& a, const Trial& b) {
  return a.evidence > b.evidence;
}

/// Within 10 % of each other in S: such trials lead to the same place.
[[nodiscard]] bool near_band(const Valve& a, const Valve& b);

/// The best wanted trials of different bands, best first.
[[nodiscard]] std::vector<Trial> leading(std::vector<Trial> trials, std::size_t count,
                                         const std::function<bool(const Trial&)>& wanted);

/// Enough rows for the fit, and pv moves.
[[nodiscard]] bool fittable(const ValveRecords::Entry& entry);

/// Cycle length of op for swings as wide as the valve's band, samples; infinite = none so wide.
[[nodiscard]] double period_of(const ValveRecords& records, const Valve& valve);

/// Tracks the valve, from that process, up to `passes` times, each from the process of the pass
/// before, and keeps the best; the entry remembers the process of the best of all.
[[nodiscard]] Trial judge(const ValveRecords& records, ValveRecords::Entry& entry,
                          const Valve& valve, const LaggedModel& start, int passes);

}  // namespace loopscope::core::model
