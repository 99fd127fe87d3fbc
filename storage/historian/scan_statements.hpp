#pragma once

#include <string>
#include <vector>

#include "storage/historian/resolve_layout.hpp"
#include "storage/historian/scan.hpp"
#include "storage/statement.hpp"

/// The statements that read rows, made from a layout whose names were found in the catalogue and
/// quoted.
namespace loopscope::storage::historian_statements {

/// Newest rows of many keys, newest first: one array per part of the key, lower bounds, upper
/// bounds, largest numbers of rows, lower bounds for the row before -> slot, times, rows of unknown
/// quality, values of each column, and time and value of the row before of each column that wants
/// it. Bad values are NULL. `relations` (at least one) hold the span and what lies before it. Of
/// rows on another server it reads one scan (scan_parameters).
[[nodiscard]] Statement read_scans(const ResolvedLayout& layout,
                                   const std::vector<std::string>& relations,
                                   const std::vector<ScanColumn>& columns);

/// One pass over the table for all of many keys that ask for the same span, and what the planner
/// makes of that. Of the parameters the plan takes the first four.
struct HeapOrderStatements {
  Statement plan;
  Statement read;
};
/// Array of the keys (of one part), lower bound, upper bound, rows of all together at most, array
/// of lower bounds of the row before -> as read_scans(), the rows in the table's order.
[[nodiscard]] HeapOrderStatements read_in_heap_order(const ResolvedLayout& layout,
                                                     const std::vector<std::string>& relations,
                                                     const std::vector<ScanColumn>& columns);

/// Time of the newest row of each key: one array per part of the key (of rows on another server:
/// the part itself, of one key), lower bound, upper bound -> slot, time. With a `column` (quoted,
/// h."column") only rows count that have a value there.
[[nodiscard]] Statement newest_rows(const ResolvedLayout& layout,
                                    const std::vector<std::string>& relations,
                                    const std::string& column);

/// The newest row of a whole table: lower bound, upper bound -> each part of its key as text, its
/// time.
[[nodiscard]] Statement newest_row(const ResolvedLayout& layout, const std::string& relation);

/// Times of the rows of a key, newest first: each part of the key, lower bound, upper bound, rows
/// at most.
[[nodiscard]] Statement times_of_key(const ResolvedLayout& layout, const std::string& relation);

/// Some row: each part of its key as text, its time.
[[nodiscard]] Statement any_row(const ResolvedLayout& layout, const std::string& relation);

/// Reads nothing, needs every right that reading a value needs.
[[nodiscard]] Statement try_read(const ResolvedLayout& layout, const std::string& value);

}  // namespace loopscope::storage::historian_statements
