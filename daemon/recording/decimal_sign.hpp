#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "daemon/text/csv_table.hpp"

namespace loopscope::daemon {

/// The decimal sign of these columns of a table, '.' or ','. What was `said` holds; else the point
/// where commas separate the cells, or where no cell has a comma; else the comma. Throws Failure
/// (unusable_data) where every comma may as well group thousands ("1,234").
[[nodiscard]] char find_decimal_sign(const CsvTable& table, const std::vector<std::size_t>& columns,
                                     std::optional<char> said);

}  // namespace loopscope::daemon
