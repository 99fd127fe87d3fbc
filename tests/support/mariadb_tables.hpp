#pragma once

#include <string>

#include "tests/support/test_database.hpp"

namespace loopscope::tests {

/// The rows of a table of PostgreSQL as an INSERT for MariaDB.
[[nodiscard]] std::string as_insert(const TestDatabase& database, const std::string& table);
/// The table itself, without keys, in MariaDB's types.
[[nodiscard]] std::string as_create(const TestDatabase& database, const std::string& table);

}  // namespace loopscope::tests
