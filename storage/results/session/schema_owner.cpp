#include "storage/results/session/schema_owner.hpp"

#include "storage/results/session/schema_statements.hpp"

namespace loopscope::storage {
namespace {

constexpr const char* kOwnersGroup = "loopscope_owner";

/// What is to be done for a schema that was made when superusers were taken.
std::string whose(const SchemaOwner& found) {
  if (found.owner.empty() || found.owner == kOwnersGroup) return "";
  return "; give it the schema, which belongs to " + found.owner +
         " (RUNBOOK, A schema that a superuser owns)";
}

void refuse_stranger(const SchemaOwner& found) {
  if (found.owner_trusted) return;
  throw DatabaseError(
      "the schema loopscope belongs to " + found.owner + ", who is not a member of loopscope_owner",
      "nothing of it was executed; whoever made it can let any session that uses it run what he "
      "likes: let a superuser drop or rename it, or, if it is yours, GRANT loopscope_owner TO its "
      "owner",
      Remedy::give_up);
}

/// To become another role would not do: any function of the schema can go back by RESET ROLE, and a
/// member of a superuser's role can become that one.
void refuse_superuser(const SchemaOwner& found) {
  if (found.superuser.empty()) return;
  const std::string what = found.superuser == found.login
                               ? "a superuser"
                               : "a member of the superuser " + found.superuser;
  throw DatabaseError("the login " + found.login + " of the results database is " + what,
                      "nothing of the schema was executed; connect as a login that is a member of "
                      "loopscope_owner (migrate, maintain) or loopscope_worker: as a superuser, "
                      "psql -d DATABASE -f deploy/roles.sql makes these groups" +
                          whose(found),
                      Remedy::give_up);
}

}  // namespace

SchemaOwner find_schema_owner(Transaction& transaction) {
  const pqxx::row row = transaction.run(statements::kFindSchemaOwner, {transaction.login()})[0];
  return {row["login"].c_str(), row["superuser"].c_str(), row["owner"].c_str(),
          row["owner_trusted"].as<bool>()};
}

void enter_schema(Transaction& transaction) {
  const SchemaOwner found = find_schema_owner(transaction);
  refuse_stranger(found);
  refuse_superuser(found);
}

}  // namespace loopscope::storage
