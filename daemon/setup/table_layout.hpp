#pragma once

#include <optional>
#include <vector>

#include "daemon/setup/layout_candidate.hpp"

namespace loopscope::daemon {

/// How a table that belongs to no vendor's set can be read, by the types and names of its columns:
/// a value a row (narrow), a loop's values a row (loop_row, telegraf), or all of them (wide).
/// `tables` are all of the database, among them perhaps one of names for numbers. nullopt = it
/// looks like no history. Time kind and quality rule are the likeliest: row_contents looks at rows.
/// Throws Failure (usage) for a wish that is no column.
[[nodiscard]] std::optional<LayoutCandidate> table_layout(
    const storage::SeenTable& table, const std::vector<storage::SeenTable>& tables,
    const LayoutWishes& wishes);

}  // namespace loopscope::daemon
