#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "daemon/text/csv_table.hpp"
#include "daemon/text/failure.hpp"

namespace loopscope::daemon {

/// A cell as a message shows it: in quotes, every byte that is no printable UTF-8 as \xNN, and of a
/// long one the first 60 characters and "...".
[[nodiscard]] std::string shown(std::string_view cell);

/// Failure (unusable_data) that says: file, line and column of the cell, then the problem.
[[nodiscard]] Failure cell_failure(const CsvTable& table, const CsvTable::Row& row,
                                   std::size_t column, const std::string& problem,
                                   const std::string& hint);

}  // namespace loopscope::daemon
