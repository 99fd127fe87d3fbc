#pragma once

#include <pqxx/pqxx>
#include <string>

#include "storage/results/session/session.hpp"

namespace loopscope::storage {

/// Whether the migrations recorded (version, name, sha256, by version) are superseded ones.
[[nodiscard]] bool made_by_superseded(const pqxx::result& applied);

/// Takes a schema over that all superseded migrations have made: what holds no rows (views,
/// functions) is made anew in the words of today, what only the chain needed goes, and its rows of
/// schema_migration become those of the migrations that stand for it. No table that holds
/// rows is touched. Returns the names of those migrations. Refuses (DatabaseError) a chain that
/// ends earlier, and one of other words.
std::vector<std::string> replace_superseded(Transaction& transaction, const pqxx::result& applied);

/// Throws the refusal of a schema: DatabaseError with Remedy::give_up.
[[noreturn]] void refuse_schema(const std::string& what, const std::string& hint);

}  // namespace loopscope::storage
