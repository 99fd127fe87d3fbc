#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "config/settings.hpp"
#include "core/diagnosis/diagnose.hpp"
#include "storage/results/results_database.hpp"

namespace loopscope::daemon {

/// Which windows get a loop model. It costs tens of times what all else costs, so on a large plant
/// loops that give no cause take turns.
struct ModelPolicy {
  /// nullopt: a model whatever the statistics say. Else only where they give this cause.
  std::optional<core::ModelTrigger> cause;
};

/// The wish for one slot of a claimed loop. Whatever the statistics say: where the plant is small
/// enough, where the loop's last verdict was a fault (so that a finding of the model stands or
/// falls by the model again) or nothing could be said, and where it is the loop's turn. The same
/// slot has the same turn whenever it is done.
[[nodiscard]] ModelPolicy model_wish(const config::Settings& settings, std::size_t enabled_loops,
                                     const storage::ClaimedLoop& claim, std::int64_t slot_end_us);

}  // namespace loopscope::daemon
