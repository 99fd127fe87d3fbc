#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "storage/historian/narrow_layout.hpp"
#include "storage/historian/pq_connection.hpp"

namespace loopscope::storage {

/// A relation name from the settings, split at its first dot.
struct RelationName {
  std::string schema;  ///< empty = found through the search path
  std::string table;   ///< may hold dots
};
[[nodiscard]] RelationName split_relation(const std::string& relation);

/// A layout whose names were found in the database's catalogue; all of them quoted for SQL.
struct ResolvedLayout {
  NarrowLayout layout;
  std::uint32_t relation_oid = 0;
  bool is_table = false;  ///< has indexes of its own (no view, no foreign table)
  std::string relation;   ///< "schema"."table"
  std::string tag, time, value;
  std::string value_cast;  ///< what makes the value a double: ::float8 or ::int4::float8
  std::string quality;     ///< empty = every finite value is good
  std::string tag_type;    ///< SQL type that requested tags are sent as: text, int8, uuid, bpchar
};

/// Whether the layout judges quality at all.
[[nodiscard]] bool has_quality(const NarrowLayout& layout);

/// Looks the relation and its columns up and checks their types. Throws DatabaseError (give_up)
/// that names what is missing or does not fit.
[[nodiscard]] ResolvedLayout resolve_layout(PqConnection& connection, const NarrowLayout& layout);

/// `tag` as the tag column's type takes it; nullopt when no row can have it (a word in a column of
/// numbers, bytes that are no text): such a tag is unknown and must not fail its whole batch.
[[nodiscard]] std::optional<std::string> native_tag(const std::string& tag,
                                                    const std::string& tag_type);

}  // namespace loopscope::storage
