#include "storage/results/schema_owner.hpp"

#include "storage/results/statements.hpp"

namespace loopscope::storage {
namespace {

constexpr const char* kOwnersGroup = "loopscope_owner";

void refuse_stranger(const SchemaOwner& found) {
  if (found.owner_trusted) return;
  throw DatabaseError(
      "the schema loopscope belongs to " + found.owner + ", who is no member of loopscope_owner",
      "nothing of it was executed; whoever made it can let any session that uses it run what he "
      "likes: let a superuser drop or rename it, or, if it is yours, GRANT loopscope_owner TO its "
      "owner",
      Remedy::give_up);
}

void refuse_superuser(const SchemaOwner& found) {
  if (!found.group_exists) {
    throw DatabaseError(
        "the login " + found.login + " is a superuser, and there is no role loopscope_owner",
        "as a superuser: psql -f deploy/roles.sql, then connect as a login that is a member of "
        "loopscope_owner, a worker as one of loopscope_worker",
        Remedy::give_up);
  }
  if (found.owner.empty() || found.owner == kOwnersGroup) return;
  throw DatabaseError("the login " + found.login +
                          " is a superuser, and the schema loopscope belongs to " + found.owner,
                      "give the schema to loopscope_owner (RUNBOOK, A schema that a superuser "
                      "owns), and connect as a login that is a member of a group role",
                      Remedy::give_up);
}

}  // namespace

SchemaOwner find_schema_owner(Transaction& transaction) {
  const pqxx::row row = transaction.run(statements::kFindSchemaOwner)[0];
  return {row["login"].c_str(),        row["superuser_login"].as<bool>(),
          row["superuser"].as<bool>(), row["group_exists"].as<bool>(),
          row["owner"].c_str(),        row["owner_trusted"].as<bool>()};
}

void enter_schema(Transaction& transaction) {
  const SchemaOwner found = find_schema_owner(transaction);
  refuse_stranger(found);
  if (!found.superuser) return;
  refuse_superuser(found);
  transaction.run(statements::kLeaveSuperuser);
}

}  // namespace loopscope::storage
