#pragma once

#include <string_view>
#include <vector>

#include "daemon/setup/layout_candidate.hpp"

namespace loopscope::daemon {

/// Whether a preset is of a vendor whose tables have names and columns of their own: all but
/// narrow, loop_row, wide and Telegraf's, whose tables are called as a site likes.
[[nodiscard]] bool is_vendor(std::string_view preset);

/// The presets of vendors whose own tables and columns are all there, in the preset's schema or all
/// of them in another one.
[[nodiscard]] std::vector<LayoutCandidate> vendor_layouts(
    const std::vector<storage::SeenTable>& tables);

/// Which tables and columns of a vendor's preset are not there, in words; empty = they all are.
[[nodiscard]] std::string missing_of_vendor(const std::vector<storage::SeenTable>& tables,
                                            const std::string& preset);

/// The tables that a preset names by itself; empty where the site says them. For who cannot look.
[[nodiscard]] std::vector<storage::TableName> usual_tables(const std::string& preset);

}  // namespace loopscope::daemon
