#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "storage/historian/column_types.hpp"
#include "storage/historian/pq_connection.hpp"
#include "storage/historian/quality_sql.hpp"
#include "storage/historian/source_layout.hpp"

namespace loopscope::storage {

/// A side table of names, quoted.
struct ResolvedNames {
  std::string relation, name, id;
  std::string order;  ///< empty = ids in their own order
  std::string hold;   ///< empty = not told
};

/// A column of the key, quoted.
struct ResolvedKey {
  std::string column;
  std::string type;  ///< SQL type that requested keys are sent as: text, int8, uuid, bpchar
  std::optional<ResolvedNames> names;
};

/// The table that lists tables, quoted.
struct ResolvedPartitions {
  std::string relation, name, start, end;
  std::string schema;  ///< where the listed tables are looked for
};

/// A layout whose names were found in the database's catalogue; all of them quoted for SQL, columns
/// of the data as h."column".
struct ResolvedLayout {
  SourceLayout layout;
  FoundRelation data;  ///< the table, or the first of the listed ones
  std::vector<ResolvedKey> key;
  std::string time, nanos, tiebreak;  ///< nanos and tiebreak may be empty
  std::string zone;                   ///< of timestamp_local, as a literal
  QualitySql quality;
  std::optional<ResolvedPartitions> partitions;
};

/// Looks relations and columns up and checks their types. Throws DatabaseError (give_up) that names
/// what is missing or does not fit.
[[nodiscard]] ResolvedLayout resolve_layout(PqConnection& connection, const SourceLayout& layout);

/// SQL of the double that a tag's row holds, its quality included: NULL for bad ones (NaN where the
/// layout says that NULL is no row). `column` is the tag's own in loop_row and wide tables and
/// empty in narrow ones; nullopt when there is no such column or it holds nothing that reads as a
/// number.
[[nodiscard]] std::optional<std::string> value_of(const PqConnection& connection,
                                                  const ResolvedLayout& layout,
                                                  const std::string& column);

/// `key` as the key column's type takes it; nullopt when no row can have it (a word in a column of
/// numbers, bytes that are no text): such a tag is unknown and must not fail its whole batch.
[[nodiscard]] std::optional<std::string> native_key(const std::string& key,
                                                    const std::string& type);

}  // namespace loopscope::storage
