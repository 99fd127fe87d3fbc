#pragma once

#include <string>

#include "storage/historian/resolve_layout.hpp"
#include "storage/statement.hpp"

/// The closed list of statements on a historian. Those that name its table are made from a layout
/// whose names were found in the catalogue and quoted. Bounds are texts of native_bound().
namespace loopscope::storage::historian_statements {

/// schema, table, schemas to look in where none is named -> oid, schema, table, is_table
extern const Statement kFindRelation;
/// Those of a list of oids that are relations.
extern const Statement kStillThere;
/// relation oid -> whether any of its rows come out of a foreign table, below views and partitions;
/// the foreign data wrapper of the relation itself, NULL = it is no foreign table; whether any of
/// them is of tds_fdw
extern const Statement kElsewhere;
/// oid of a foreign table -> its server, wrapper, options dbname and fetch_size (NULL = not set),
/// whether the server itself has a fetch_size
extern const Statement kForeignTable;
extern const Statement kColumns;  ///< relation oid -> name, type
/// relation oid -> key columns, all columns: names in hexadecimal digits, comma-separated
extern const Statement kIndexes;
/// relation oid -> relkind, whether it is a hypertable of TimescaleDB, schema,
/// owner
extern const Statement kTableKind;
/// relation oid -> oid, schema, name and relkind of each of its partitions, by name
extern const Statement kPartitions;
/// relation oids -> schema, name, whether the login may read it, the login, the owner
extern const Statement kReadRights;
/// relation oid -> whether the login may insert there, the login
extern const Statement kWriteRight;
extern const Statement kNow;  ///< -> its clock, its start: int8, microseconds UTC since 1970
extern const Statement kBegin;
extern const Statement kCommit;

extern const Statement kFindZone;  ///< name of a time zone -> a row

/// Names -> name, id, code of how the tag is archived; several ids of a name in the order in which
/// they were made. Names are found as they are and, with `lower_too`, in lower case.
[[nodiscard]] Statement find_ids(const ResolvedNames& names, bool lower_too);
/// The same in any case; no index serves it.
[[nodiscard]] Statement find_ids_in_any_case(const ResolvedNames& names);
/// Names (in any case) -> ids. The names are quoted.
[[nodiscard]] Statement ids_of_names(const std::string& relation, const std::string& name,
                                     const std::string& id);

/// -> name, first time, last time of every listed table, the times as `kind` counts them.
[[nodiscard]] Statement list_partitions(const ResolvedPartitions& list, TimeKind kind);

/// Every name of a side table.
[[nodiscard]] Statement list_names(const ResolvedNames& names);

/// Every key as texts, one column a part, where a part has a table of names by its name: by a loose
/// scan of the index on (key, time), or by reading the table.
[[nodiscard]] Statement list_keys(const ResolvedLayout& layout, const std::string& relation,
                                  bool loose_scan);

/// The plan of `statement` as text, a row a line; `with_sent` = with what other servers are
/// sent.
[[nodiscard]] Statement explain(const Statement& statement, bool with_sent);

/// The plain narrow table that recordings are loaded into, quoted.
struct PlainTable {
  std::string relation, tag, time, value, quality;  ///< quality empty = none
  TimeKind time_kind = TimeKind::timestamptz;
};

/// Whether a tag has rows in a span: tag, lower bound, upper bound -> boolean. `tag_type` is a SQL
/// type.
[[nodiscard]] Statement has_rows(const PlainTable& table, const std::string& tag_type);

/// Deletes a tag's rows in a span: tag, lower bound, upper bound.
[[nodiscard]] Statement delete_rows(const PlainTable& table, const std::string& tag_type);

/// COPY in text format: tag, time, value and, where it is judged, quality.
[[nodiscard]] Statement copy_rows(const PlainTable& table);

[[nodiscard]] Statement create_table(const PlainTable& table);
[[nodiscard]] Statement create_index(const PlainTable& table);

}  // namespace loopscope::storage::historian_statements
