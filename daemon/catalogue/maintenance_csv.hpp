#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "daemon/text/csv_table.hpp"
#include "daemon/text/time_zone.hpp"
#include "storage/results/catalogue/maintenance.hpp"

namespace loopscope::daemon {

/// One entry of the log of work out of the words of a user; `at` without an offset is meant in
/// `zone`. Throws std::invalid_argument naming what is wrong: a time that is none, an unknown kind
/// (with the nearest one), no description.
[[nodiscard]] storage::MaintenanceEntry maintenance_entry(std::string_view loop,
                                                          std::string_view at,
                                                          std::string_view kind,
                                                          std::string_view description,
                                                          const TimeZone& zone);

/// Whether a file with this header holds work: it has the columns of parse_maintenance().
[[nodiscard]] bool is_header_of_maintenance(const std::vector<std::string>& header);

/// Entries out of a table with the columns loop, at, kind and description in any order. Throws
/// Failure (unusable_data) naming line and column.
[[nodiscard]] std::vector<storage::MaintenanceEntry> parse_maintenance(const CsvTable& table,
                                                                       const TimeZone& zone);

}  // namespace loopscope::daemon
