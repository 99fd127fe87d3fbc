#pragma once

#include <cstddef>
#include <cstdint>

#include "config/settings.hpp"
#include "storage/results/results_database.hpp"

namespace loopscope::daemon {

/// Which windows get a loop model. It costs tens of times what all else costs, so on a large plant
/// loops that give no cause take turns.
enum class ModelWish {
  always,
  where_there_is_cause,  ///< only where the statistics by themselves find anything but health
};

/// The wish for one slot of a claimed loop. `always` where the plant is small enough, where the
/// loop's last verdict was not health (so that a finding of the model stands or falls by the model
/// again), and where it is the loop's turn. The same slot has the same turn whenever it is done.
[[nodiscard]] ModelWish model_wish(const config::ScheduleSettings& schedule,
                                   std::size_t enabled_loops, const storage::ClaimedLoop& claim,
                                   std::int64_t slot_end_us);

}  // namespace loopscope::daemon
