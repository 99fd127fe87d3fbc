#pragma once

#include <string>
#include <vector>

#include "storage/results/reports/report_rows.hpp"

namespace loopscope::daemon {

/// What was done, what became of it in one word, why, and the figures before and after.
[[nodiscard]] std::string repairs_table(const std::vector<storage::RepairRow>& repairs);

}  // namespace loopscope::daemon
