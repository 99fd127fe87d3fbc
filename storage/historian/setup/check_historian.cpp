#include "storage/historian/setup/check_historian.hpp"

#include <string>
#include <utility>

#include "storage/check_connection.hpp"
#include "storage/historian/check_index.hpp"
#include "storage/historian/foreign_plan.hpp"
#include "storage/historian/pq_connection.hpp"
#include "storage/historian/resolve_layout.hpp"
#include "storage/historian/scan_statements.hpp"
#include "storage/historian/setup/check_foreign_table.hpp"
#include "storage/historian/setup/check_newest.hpp"
#include "storage/historian/setup/check_window.hpp"
#include "storage/historian/setup/read_grants.hpp"
#include "storage/historian/statements.hpp"

namespace loopscope::storage {
namespace {

// What looks for the newest row may have to scan the table: not for long.
constexpr int kStatementTimeout_s = 10;

void check_reading(PqConnection& connection, const ResolvedLayout& layout,
                   std::vector<Finding>& findings) {
  const std::int64_t now_us = std::stoll(connection.run(historian_statements::kNow).text(0, 0));
  findings.push_back(check_index(connection, layout));
  for (Finding& found : check_foreign_table(connection, layout, now_us))
    findings.push_back(std::move(found));
  for (Finding& found : check_window(connection, layout, now_us))
    findings.push_back(std::move(found));
  findings.push_back(check_newest(connection, layout, now_us));
}

}  // namespace

std::vector<Finding> check_historian(const ConnectionSettings& settings,
                                     const SourceLayout& layout) {
  ConnectionSettings reader = settings;
  reader.read_only = true;
  reader.statement_timeout_s = kStatementTimeout_s;
  std::vector<Finding> findings;
  try {
    findings = check_connection(reader);
    PqConnection connection(reader);
    findings.push_back({true, "connected to the " + connection.target(), "", false});
    ResolvedLayout resolved = resolve_layout(connection, layout);
    if (const auto lacking = check_read_rights(connection, resolved)) {
      findings.push_back(*lacking);
      return findings;
    }
    connection.run(historian_statements::try_read(resolved, any_value(connection, resolved)));
    findings.push_back({true, resolved.data.sql + " has the columns and can be read", "", false});
    resolved.largest_elsewhere = asks_for_largest(connection, resolved);
    check_reading(connection, resolved, findings);
  } catch (const DatabaseError& error) {
    findings.push_back({false, error.what(), error.hint(), false});
  } catch (const MalformedArray& error) {
    findings.push_back({false, std::string(error.what()) + ", " + layout.relation,
                        "report this with the server's version", false});
  }
  return findings;
}

}  // namespace loopscope::storage
