#include "storage/results/schema/check_results.hpp"

#include "storage/check_connection.hpp"
#include "storage/results/schema/schema_version.hpp"
#include "storage/results/session/schema_owner.hpp"
#include "storage/results/session/schema_statements.hpp"
#include "storage/results/session/session.hpp"

namespace loopscope::storage {
namespace {

/// "CREATE on schema loopscope" as what somebody does: "CREATE in schema loopscope".
std::string as_deed(std::string right) {
  const std::size_t on = right.find(" on ");
  const std::string preposition = right.starts_with("DELETE") ? " from " : " in ";
  return right.replace(on, 4, preposition);
}

Finding check_right(const pqxx::row& row) {
  const std::string what = row["what"].c_str();
  const bool needed = row["needed"].as<bool>();
  const bool granted = row["granted"].as<bool>();
  if (needed && granted) return {true, "the worker has " + what, "", false};
  if (!needed && !granted)
    return {true, "the worker cannot " + as_deed(what) + ", as it should be", "", false};
  if (needed) {
    return {false, "the worker has no right to " + what + ", results database",
            "make the user a member of loopscope_worker and run `loopscope migrate --config F` as "
            "the owner, which grants that role's rights",
            false};
  }
  return {true, "the worker has the right to " + what + ", which it does not need",
          "connect as a login that is only a member of loopscope_worker", true};
}

Finding check_engineer_right(const pqxx::row& row) {
  const std::string what = row["what"].c_str();
  if (row["granted"].as<bool>()) return {true, "the engineer has " + what, "", false};
  return {false, "the engineer has no right to " + what + ", results database",
          "make the user a member of loopscope_engineer and run `loopscope migrate --config F` as "
          "the owner, which grants that role's rights",
          false};
}

/// Whose the schema is decides what runs in it, and with which rights.
void name_owner(const SchemaOwner& found, std::vector<Finding>& findings) {
  if (!found.owner.empty())
    findings.push_back({true, "the schema loopscope belongs to " + found.owner, "", false});
}

/// `judge` says what is to be said of a row of `rights`.
std::vector<Finding> check_schema(const ConnectionSettings& settings, const Statement& rights,
                                  Finding (*judge)(const pqxx::row&), SchemaStage stage) {
  std::vector<Finding> findings;
  try {
    findings = check_connection(settings);
    Session session(settings);
    findings.push_back({true, "connected to the " + describe_target(settings), "", false});
    const SchemaOwner owner = session.transact(find_schema_owner);
    name_owner(owner, findings);
    if (session.transact(schema_version) == 0) {
      findings.push_back({stage == SchemaStage::to_be_made,
                          "not migrated yet: there is no schema loopscope",
                          "`loopscope migrate --config F` makes it", false});
      return findings;
    }
    require_schema_version(session);
    findings.push_back({true, "the schema loopscope has this program's version", "", false});
    const pqxx::result rows =
        session.transact([&](Transaction& transaction) { return transaction.run(rights); });
    for (const pqxx::row& row : rows) findings.push_back(judge(row));
  } catch (const DatabaseError& error) {
    findings.push_back({false, error.what(), error.hint(), false});
  }
  return findings;
}

}  // namespace

std::vector<Finding> check_results(const ConnectionSettings& settings, SchemaStage stage) {
  return check_schema(settings, statements::kCheckRights, check_right, stage);
}

std::vector<Finding> check_engineer(const ConnectionSettings& settings, SchemaStage stage) {
  return check_schema(settings, statements::kCheckEngineerRights, check_engineer_right, stage);
}

}  // namespace loopscope::storage
