#include "storage/results/schema/check_results.hpp"

#include "storage/check_connection.hpp"
#include "storage/results/schema/schema_version.hpp"
#include "storage/results/session/schema_owner.hpp"
#include "storage/results/session/schema_statements.hpp"
#include "storage/results/session/session.hpp"

namespace loopscope::storage {
namespace {

Finding check_right(const pqxx::row& row) {
  const std::string what = row["what"].c_str();
  const bool needed = row["needed"].as<bool>();
  const bool granted = row["granted"].as<bool>();
  Finding finding{granted || !needed, "results: " + (granted ? what : "no " + what), "", false};
  if (needed && !granted) {
    finding.what = "no right to " + what + ", results database";
    finding.hint =
        "make the user a member of loopscope_worker and run `loopscope migrate --config F` as the"
        " owner, which grants that role's rights";
  } else if (!needed && granted) {
    finding.warning = true;
    finding.what = "the worker has the right to " + what + ", which it does not need";
    finding.hint = "connect as a login that is only a member of loopscope_worker";
  }
  return finding;
}

/// Whose the schema is decides what runs in it, and with which rights.
void check_owner(const SchemaOwner& found, std::vector<Finding>& findings) {
  if (!found.owner.empty())
    findings.push_back({true, "the schema loopscope belongs to " + found.owner, "", false});
}

}  // namespace

std::vector<Finding> check_results(const ConnectionSettings& settings) {
  std::vector<Finding> findings;
  try {
    findings = check_connection(settings);
    Session session(settings);
    findings.push_back({true, "connected to the " + describe_target(settings), "", false});
    const SchemaOwner owner = session.transact(find_schema_owner);
    check_owner(owner, findings);
    require_schema_version(session);
    findings.push_back({true, "the schema loopscope has this program's version", "", false});
    const pqxx::result rights = session.transact(
        [](Transaction& transaction) { return transaction.run(statements::kCheckRights); });
    for (const pqxx::row& row : rights) findings.push_back(check_right(row));
  } catch (const DatabaseError& error) {
    findings.push_back({false, error.what(), error.hint(), false});
  }
  return findings;
}

}  // namespace loopscope::storage
