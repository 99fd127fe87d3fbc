#include "storage/historian/setup/check_writer.hpp"

#include <string>

#include "storage/historian/column_types.hpp"
#include "storage/historian/pq_connection.hpp"
#include "storage/historian/statements.hpp"

namespace loopscope::storage {
namespace {

Finding check_insert(PqConnection& connection, const SourceLayout& layout) {
  const auto table = find_relation(connection, split_relation(layout.relation));
  if (!table) return {true, "there is no table " + layout.relation + " yet", "", false};
  const PqRows rows =
      connection.run(historian_statements::kWriteRight, {std::to_string(table->oid)});
  const std::string user = rows.text(0, 1);
  if (rows.text(0, 0) == "t")
    return {true, user + " may insert into " + table->sql + ", as `import` does", "", false};
  return {false, user + " may not insert into " + table->sql + ", so `import` would fail",
          "as the owner: GRANT SELECT, INSERT, DELETE ON " + table->sql + " TO " +
              connection.quote(user),
          false};
}

}  // namespace

std::vector<Finding> check_writer(const ConnectionSettings& settings, const SourceLayout& layout) {
  std::vector<Finding> findings;
  try {
    findings = check_connection(settings);
    PqConnection connection(settings);
    findings.push_back({true, "connected to the " + connection.target(), "", false});
    findings.push_back(check_insert(connection, layout));
  } catch (const DatabaseError& error) {
    findings.push_back({false, error.what(), error.hint(), false});
  }
  return findings;
}

}  // namespace loopscope::storage
