#pragma once

#include <functional>
#include <string>

namespace loopscope::tests {

/// A database that is filled once on a server and then copied: most tests need the whole schema,
/// and its migrations take longer than they do.
struct TemplateDatabase {
  /// Tells apart what is filled in different ways, so that nobody copies what an older program
  /// left on a server that was kept running.
  std::string name;
  std::function<void(const std::string& conninfo)> fill;
};

/// Makes `database` a copy; the first of all processes that ask makes what is copied. `server` is a
/// superuser's connection string.
/// @throws std::runtime_error with the server's words, and what `fill` throws
void copy_template(const std::string& server, const TemplateDatabase& filled,
                   const std::string& database);

}  // namespace loopscope::tests
