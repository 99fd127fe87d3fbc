#include "storage/results/schema/superseded_migrations.hpp"

#include <gmock/gmock.h>
#include <sstream>

#include "storage/results/schema/migrate.hpp"
#include "tests/storage/results/upgrade_fixture.hpp"

namespace loopscope::storage {
namespace {

/// former_schema.sha256 is what `sha256sum` printed of each file when it was given out.
TEST(FormerChain, IsWhatDatabasesHold) {
  std::istringstream kept(
      tests::content_of(tests::source_dir() / "tests/storage/results/former_schema.sha256"));
  std::string sha256, file;
  for (const SupersededMigration& migration : superseded_migrations()) {
    ASSERT_TRUE(kept >> sha256 >> file) << migration.name;
    EXPECT_EQ(file, std::string(migration.name) + ".sql");
    EXPECT_EQ(sha256, migration.sha256) << migration.name;
    const tests::ProgramResult sum = tests::run_program(
        {"/usr/bin/sha256sum", tests::source_dir() / "tests/storage/results/former_schema" / file});
    EXPECT_EQ(sum.out.substr(0, 64), migration.sha256) << migration.name;
  }
  EXPECT_FALSE(kept >> sha256);
}

/// Every object, comment and right; not the random words that guard a dump against psql commands.
std::string schema_of(const tests::TestDatabase& database) {
  const tests::ProgramResult dump = tests::run_program(
      {"/usr/bin/pg_dump", "--schema-only", "--schema=loopscope", database.conninfo()});
  EXPECT_EQ(dump.exit_code, 0) << dump.err;
  std::istringstream lines(dump.out);
  std::string text;
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with("\\restrict ") && !line.starts_with("\\unrestrict ")) text += line + '\n';
  return text;
}

/// One schema and not two: what is made anew and what is taken over differ in nothing.
TEST_F(UpgradeTest, TheSchemaIsThatOfAnEmptyDatabase) {
  tests::TestDatabase anew;
  anew.make_roles();
  migrate(settings_for(anew, anew.make_login("loopscope_owner")));
  anew.execute("SET ROLE loopscope_owner; SELECT loopscope.make_partitions('2026-01-01', 1)");
  tests::TestDatabase taken;
  taken.make_roles();
  make_former_schema(taken, "loopscope_owner");
  const std::string former = schema_of(taken);
  migrate(settings_for(taken, owner));
  const std::string now = schema_of(taken);
  EXPECT_THAT(former, testing::HasSubstr("FUNCTION loopscope.grant_rights_of_0023()"));
  EXPECT_THAT(now, testing::Not(testing::HasSubstr("_of_00")));
  EXPECT_THAT(now, testing::HasSubstr("VIEW loopscope.flagged_loop"));
  migrate(settings_for(anew, owner));
  EXPECT_EQ(now, schema_of(anew));
  for (const char* const table : {"parameter", "data_problem_kind", "task_lease"}) {
    const std::string rows =
        "SELECT row(given.*)::text FROM loopscope." + std::string(table) + " AS given ORDER BY 1";
    EXPECT_EQ(taken.rows(rows), anew.rows(rows)) << table;
  }
}

}  // namespace
}  // namespace loopscope::storage
