#pragma once

#include <functional>
#include <string>

#include "tests/support/reused_connection.hpp"

namespace loopscope::tests {

/// A database that is filled once on a server and then copied: most tests need the whole schema,
/// and its migrations take longer than they do.
struct TemplateDatabase {
  /// Tells apart what is filled in different ways, so that nobody copies what an older program
  /// left on a server that was kept running.
  std::string name;
  std::function<void(const std::string& conninfo)> fill;
};

/// End of a CREATE DATABASE that copies files instead of logging each block, which is the faster
/// way on a server without fsync; nothing for servers before 15, which know no other.
[[nodiscard]] std::string copy_strategy(const ReusedConnection& server);

/// Makes `database` a copy; the first of all processes that ask makes what is copied. `server` is a
/// superuser's connection, `conninfo` its connection string.
/// @throws std::runtime_error with the server's words, and what `fill` throws
void copy_template(const ReusedConnection& server, const std::string& conninfo,
                   const TemplateDatabase& filled, const std::string& database);

}  // namespace loopscope::tests
