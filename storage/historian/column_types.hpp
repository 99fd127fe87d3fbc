#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "storage/historian/pq_connection.hpp"

namespace loopscope::storage {

/// A relation name from the settings, split at its first dot.
struct RelationName {
  std::string schema;  ///< empty = found through the login's own search path
  std::string table;   ///< may hold dots
};
[[nodiscard]] RelationName split_relation(const std::string& relation);

/// Types of the columns by name, as pg_type calls them. A domain counts as the type below it.
using ColumnTypes = std::map<std::string, std::string>;

/// A relation that was found in the database's catalogue.
struct FoundRelation {
  std::uint32_t oid = 0;
  bool is_table = false;  ///< has indexes of its own (no view, no foreign table)
  std::string sql;        ///< "schema"."table", quoted
  ColumnTypes types;
};

/// nullopt when there is none of that name. Throws DatabaseError.
[[nodiscard]] std::optional<FoundRelation> find_relation(PqConnection& connection,
                                                         const RelationName& name);

/// Names of the columns in words.
[[nodiscard]] std::string list_of(const ColumnTypes& types);

/// Numbers of any kind, truths and texts: what the reader makes doubles of.
[[nodiscard]] bool is_number_type(const std::string& type);
[[nodiscard]] bool is_text_type(const std::string& type);

}  // namespace loopscope::storage
