#pragma once

#include <optional>
#include <vector>

#include "storage/loop_work.hpp"
#include "storage/results/session/session.hpp"
#include "storage/results/writes/loop_windows.hpp"

namespace loopscope::storage {

/// What the windows of a loop say together up to its record, one for each of `loops`, to be written
/// with it. nullopt where the loop has a later slot, stored or in `loops`: its slots are combined
/// by write_combined() once the record is stored. In the caller's transaction, before anything of
/// the records is written.
[[nodiscard]] std::vector<std::optional<Combined>> combine_newest(
    Transaction& transaction, const std::vector<const CompletedLoop*>& loops);

}  // namespace loopscope::storage
