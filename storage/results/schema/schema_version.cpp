#include "storage/results/schema/schema_version.hpp"

#include <string>

#include "storage/results/schema/migrate.hpp"
#include "storage/results/session/schema_statements.hpp"

namespace loopscope::storage {

int schema_version(Transaction& transaction) {
  if (!transaction.run(statements::kHasSchema)[0][0].as<bool>()) return 0;
  return transaction.run(statements::kSchemaVersion)[0][0].as<int>();
}

namespace {

/// SQLSTATE invalid_schema_name: none of this name, or not in the version wanted.
constexpr const char* kOtherSchema = "3F000";

/// The lowest schema version whose programs the schema found still serves.
int oldest_program(Session& session) {
  return session.transact([](Transaction& transaction) {
    return transaction.run(statements::kOldestProgram)[0][0].as<int>();
  });
}

}  // namespace

void require_schema_version(Session& session) {
  const int found = session.transact(schema_version);
  const int required = required_schema_version();
  if (found == required) return;
  if (found > required && oldest_program(session) <= required) return;
  if (found > required) {
    throw DatabaseError("the schema loopscope has version " + std::to_string(found) +
                            ", newer than this program's " + std::to_string(required),
                        "install the newer program", Remedy::give_up, kOtherSchema);
  }
  const std::string what = found == 0
                               ? std::string("the schema loopscope does not exist")
                               : "the schema loopscope has version " + std::to_string(found) +
                                     ", this program needs " + std::to_string(required);
  throw DatabaseError(what, "run `loopscope migrate --config F` as the owner", Remedy::give_up,
                      kOtherSchema);
}

}  // namespace loopscope::storage
