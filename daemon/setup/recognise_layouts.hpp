#pragma once

#include <vector>

#include "daemon/setup/layout_candidate.hpp"

namespace loopscope::daemon {

/// Every way in which the tables of a historian can be read, as far as `wishes` leave it open: the
/// vendors' sets that are complete, else each table that looks like a history. Throws Failure
/// (usage) for a wish that is no table or no column.
[[nodiscard]] std::vector<LayoutCandidate> recognise_layouts(
    const std::vector<storage::SeenTable>& tables, const LayoutWishes& wishes);

/// A line for a list: the table, its preset, which column is what, and about how many rows.
[[nodiscard]] std::string describe(const LayoutCandidate& candidate);

}  // namespace loopscope::daemon
