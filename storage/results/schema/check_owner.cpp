#include "storage/results/schema/check_owner.hpp"

#include <string>

#include "storage/results/session/schema_statements.hpp"
#include "storage/results/session/session.hpp"

namespace loopscope::storage {
namespace {

constexpr const char* kWork = "migrate, maintain and loops";

Finding judge_maker(const std::string& login, const std::string& database, bool may_make) {
  if (may_make)
    return {true, login + " may make the schema loopscope in the database " + database, "", false};
  return {false,
          login + " may not make the schema loopscope in the database " + database +
              ", so `loopscope migrate` would fail",
          "as a superuser: psql -d " + database +
              " -f deploy/roles.sql (without -d it goes into another database), then GRANT "
              "loopscope_owner TO " +
              login,
          false};
}

Finding judge_owner(const std::string& login, const std::string& owner, bool owns) {
  if (owns) {
    return {true, login + " may change the schema loopscope, as " + kWork + " do", "", false};
  }
  return {false,
          login + " may not change the schema loopscope, which belongs to " + owner + ": " + kWork +
              " would fail",
          "as a superuser: GRANT " + owner + " TO " + login, false};
}

Finding judge_rights(const pqxx::row& row) {
  const std::string login = row["login"].c_str(), owner = row["owner"].c_str();
  if (owner.empty()) return judge_maker(login, row["database"].c_str(), row["may_make"].as<bool>());
  return judge_owner(login, owner, row["owns"].as<bool>());
}

/// What libpq says where neither the connection string nor a password file has one.
bool lacks_password(const DatabaseError& error) {
  return std::string(error.what()).find("no password supplied") != std::string::npos;
}

}  // namespace

std::vector<Finding> check_owner(const ConnectionSettings& settings) {
  std::vector<Finding> findings;
  try {
    findings = check_connection(settings);
    Session session(settings);
    findings.push_back({true, "connected to the " + describe_target(settings), "", false});
    const pqxx::result rights = session.transact(
        [](Transaction& transaction) { return transaction.run(statements::kOwnerRights); });
    findings.push_back(judge_rights(rights[0]));
  } catch (const DatabaseError& error) {
    if (lacks_password(error)) {
      findings.push_back({true,
                          "no password for this login is found here, so this host runs workers "
                          "alone: " +
                              std::string(kWork) + " would fail, " + describe_target(settings),
                          error.hint(), true});
    } else {
      findings.push_back({false, error.what(), error.hint(), false});
    }
  }
  return findings;
}

}  // namespace loopscope::storage
