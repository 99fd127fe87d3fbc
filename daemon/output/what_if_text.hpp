#pragma once

#include <string>
#include <vector>

#include "storage/results/reports/report_rows.hpp"

namespace loopscope::daemon {

/// What other thresholds would flag, as a table for a terminal: a summary, then a line for each
/// loop in the would-be order, marked `+` where it would be new, and those that would go, `-`.
[[nodiscard]] std::string what_if_text(const std::vector<storage::WhatIfRow>& rows);

}  // namespace loopscope::daemon
