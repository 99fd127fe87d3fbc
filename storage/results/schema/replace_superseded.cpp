#include "storage/results/schema/replace_superseded.hpp"

#include <string_view>

#include "storage/results/schema/embedded_migrations.hpp"
#include "storage/results/schema/superseded_migrations.hpp"
#include "storage/results/session/schema_statements.hpp"

namespace loopscope::storage {
namespace {

/// Those that stand for the superseded migrations. Of these, the ones from kFirstMadeAnew on hold
/// views and functions, each by CREATE OR REPLACE, and the one table that the chain had not.
constexpr int kFirstMadeAnew = 103;
constexpr int kLastOfTheSame = 105;

/// What the chain had wrapped once more with each change.
constexpr const char* kDropWrappers = R"(
    DROP FUNCTION IF EXISTS loopscope.grant_rights_of_0016(), loopscope.grant_rights_of_0017(),
      loopscope.grant_rights_of_0023(),
      loopscope.delete_old_rows_of_0012(timestamptz))";

const Statement kForgetChain{"forget_superseded", "DELETE FROM loopscope.schema_migration",
                             Rows::none};

/// Whether every migration recorded is the one of the chain with its number.
void check_words(const pqxx::result& applied) {
  const auto chain = superseded_migrations();
  std::size_t expected = 0;
  for (const pqxx::row& row : applied) {
    const std::string name = row["name"].c_str();
    const auto number = row["version"].as<std::size_t>();
    if (number > chain.size()) {
      refuse_schema("migration " + name + " is not known to this program",
                    "install the newer program");
    }
    const SupersededMigration& known = chain[expected++];
    if (name != known.name || row["sha256"].c_str() != std::string_view(known.sha256)) {
      refuse_schema("migration " + name +
                        " was applied with another text than this program knows of " + known.name,
                    "use the program that made the schema, or start with an empty database");
    }
  }
}

}  // namespace

void refuse_schema(const std::string& what, const std::string& hint) {
  throw DatabaseError(what + ", schema loopscope", hint, Remedy::give_up);
}

bool made_by_superseded(const pqxx::result& applied) {
  return !applied.empty() && applied[0]["version"].as<int>() < embedded_migrations().front().number;
}

std::vector<std::string> replace_superseded(Transaction& transaction, const pqxx::result& applied) {
  check_words(applied);
  const std::string last = std::to_string(superseded_migrations().size());
  if (static_cast<std::size_t>(applied.size()) < superseded_migrations().size()) {
    refuse_schema("the schema has version " + std::to_string(applied.size()) +
                      ", and this program takes over version " + last + " only",
                  "run `loopscope migrate --config F` of a program of schema version " + last +
                      " first, then this one's");
  }
  transaction.run(kForgetChain);
  std::vector<std::string> names;
  for (const Migration& migration : embedded_migrations()) {
    if (migration.number > kLastOfTheSame) break;
    if (migration.number >= kFirstMadeAnew) transaction.run_script(migration.name, migration.sql);
    transaction.run(statements::kRecordMigration,
                    {std::to_string(migration.number), migration.name, migration.sha256});
    names.emplace_back(migration.name);
  }
  transaction.run_script("drop_wrappers", kDropWrappers);
  return names;
}

}  // namespace loopscope::storage
