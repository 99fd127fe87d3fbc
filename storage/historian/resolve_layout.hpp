#pragma once

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
  FoundRelation data;    ///< the table, or the first of the listed ones
  bool foreign = false;  ///< rows come from another server: a foreign table, or one below `data`
  /// The other server is asked for the largest time of a key (asks_for_largest, for who reads).
  bool largest_elsewhere = false;
  /// What is found at run time can be sent to the other server, not constants alone.
  bool parameters_elsewhere = true;
  std::vector<ResolvedKey> key;
  std::string time, nanos, tiebreak;  ///< nanos and tiebreak may be empty
  std::string zone;                   ///< of timestamp_local, as a literal
  QualitySql quality;
  std::optional<ResolvedPartitions> partitions;
};

/// Looks relations and columns up and checks their types. Throws DatabaseError (give_up) that names
/// what is missing or does not fit.
[[nodiscard]] ResolvedLayout resolve_layout(PqConnection& connection, const SourceLayout& layout);

}  // namespace loopscope::storage
