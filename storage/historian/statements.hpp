#pragma once

#include "storage/historian/resolve_layout.hpp"
#include "storage/statement.hpp"

/// The closed list of statements on a historian. Those that name its table are made from a layout
/// whose names were found in the catalogue and quoted.
namespace loopscope::storage::historian_statements {

extern const Statement kFindRelation;  ///< schema, table -> oid, schema, table, is_table
extern const Statement kColumns;       ///< relation oid -> name, type
extern const Statement kIndexes;       ///< relation oid, tag, time -> included columns
extern const Statement kNow;
extern const Statement kBegin;
extern const Statement kCommit;

/// Newest rows of many tags, newest first: tags, lower bounds, upper bounds, largest numbers of
/// rows, lower bounds for the row before (null = not wanted) -> slot, times, values, time before,
/// value before. Bad quality is NULL.
[[nodiscard]] Statement read_rows(const ResolvedLayout& layout);

/// Time of each tag's newest row: tags, lower bound, upper bound.
[[nodiscard]] Statement newest_rows(const ResolvedLayout& layout);

/// Time of the newest row of the whole table: lower bound.
[[nodiscard]] Statement newest_row(const ResolvedLayout& layout);

/// Every tag as text: by a loose scan of the index on (tag, time), or by reading the table.
[[nodiscard]] Statement list_tags(const ResolvedLayout& layout);
[[nodiscard]] Statement distinct_tags(const ResolvedLayout& layout);

/// Reads nothing, needs every right that reading needs.
[[nodiscard]] Statement try_read(const ResolvedLayout& layout);

/// Whether a tag has rows in a span: tag, lower bound, upper bound.
[[nodiscard]] Statement has_rows(const ResolvedLayout& layout);

/// Deletes a tag's rows in a span: tag, lower bound, upper bound.
[[nodiscard]] Statement delete_rows(const ResolvedLayout& layout);

/// COPY in text format: tag, time, value and, where it is judged, quality.
[[nodiscard]] Statement copy_rows(const ResolvedLayout& layout);

/// Names that are not in the catalogue yet, quoted.
struct NewTable {
  std::string relation, tag, time, value, quality;  ///< quality empty = none
  TimeKind time_kind;
};
[[nodiscard]] Statement create_table(const NewTable& table);
[[nodiscard]] Statement create_index(const NewTable& table);

}  // namespace loopscope::storage::historian_statements
