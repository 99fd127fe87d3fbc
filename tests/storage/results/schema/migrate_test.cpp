#include "storage/results/schema/migrate.hpp"

#include <fstream>
#include <gmock/gmock.h>
#include <sstream>
#include <thread>

#include "core/diagnosis/verdicts/verdict_catalogue.hpp"
#include "storage/results/schema/embedded_migrations.hpp"
#include "tests/storage/results/results_fixture.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::storage {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// An empty database.
class MigrateTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!tests::test_server()) GTEST_SKIP() << tests::kNoServer;
    database = std::make_unique<tests::TestDatabase>();
    database->make_roles();
  }
  [[nodiscard]] std::string error_of_connecting() const {
    try {
      const ResultsDatabase results(settings_for(*database));
      return "";
    } catch (const DatabaseError& error) {
      EXPECT_EQ(error.remedy(), Remedy::give_up);
      return std::string(error.what()) + " HINT: " + error.hint();
    }
  }
  std::unique_ptr<tests::TestDatabase> database;
};

TEST(EmbeddedMigrations, AreTheFilesAsTheyStand) {
  for (const Migration& migration : embedded_migrations()) {
    const std::ifstream file(tests::source_dir() / "storage" / "migrations" /
                             (std::string(migration.name) + ".sql"));
    std::ostringstream text;
    text << file.rdbuf();
    EXPECT_EQ(migration.sql, text.str()) << migration.name;
  }
  EXPECT_EQ(embedded_migrations().back().number, required_schema_version());
}

TEST_F(MigrateTest, AppliesAllOnceAndThenNothing) {
  EXPECT_THAT(error_of_connecting(), HasSubstr("does not exist HINT: run `loopscope migrate"));
  EXPECT_THAT(migrate(settings_for(*database)), SizeIs(embedded_migrations().size()));
  EXPECT_EQ(error_of_connecting(), "");
  EXPECT_THAT(migrate(settings_for(*database)), IsEmpty());
  EXPECT_EQ(database->value("SELECT count(*) FROM loopscope.schema_migration"),
            std::to_string(embedded_migrations().size()));
  EXPECT_EQ(database->value("SELECT max(version) FROM loopscope.schema_migration"),
            std::to_string(required_schema_version()));
}

TEST_F(MigrateTest, SideBySideOneDoesTheWork) {
  std::vector<std::size_t> applied(3);
  {
    std::vector<std::jthread> runs;
    for (std::size_t& count : applied) {
      runs.emplace_back([&count, this] { count = migrate(settings_for(*database)).size(); });
    }
  }
  EXPECT_EQ(applied[0] + applied[1] + applied[2], embedded_migrations().size());
}

TEST_F(MigrateTest, EverythingHasAComment) {
  migrate(settings_for(*database));
  EXPECT_THAT(database->rows("SELECT c.relname FROM pg_class AS c"
                             " WHERE c.relnamespace = 'loopscope'::regnamespace"
                             " AND c.relkind IN ('r', 'p', 'v', 'S')"
                             " AND c.relname NOT LIKE '%\\_seq'"
                             " AND obj_description(c.oid, 'pg_class') IS NULL"),
              IsEmpty());
  EXPECT_THAT(database->rows("SELECT c.relname, a.attname FROM pg_class AS c"
                             " JOIN pg_attribute AS a ON a.attrelid = c.oid AND a.attnum > 0"
                             " WHERE c.relnamespace = 'loopscope'::regnamespace"
                             " AND c.relkind IN ('r', 'p', 'v') AND NOT a.attisdropped"
                             " AND col_description(c.oid, a.attnum) IS NULL"),
              IsEmpty());
  EXPECT_THAT(database->rows("SELECT p.proname FROM pg_proc AS p"
                             " WHERE p.pronamespace = 'loopscope'::regnamespace"
                             " AND obj_description(p.oid, 'pg_proc') IS NULL"),
              IsEmpty());
}

/// Makes the schema one of a later program, which served the programs from `oldest` on.
void migrate_further(const tests::TestDatabase& database, int oldest) {
  database.execute("INSERT INTO loopscope.schema_migration VALUES (9999, '9999_future', 'x')");
  database.execute(
      "CREATE OR REPLACE FUNCTION loopscope.oldest_program() RETURNS integer IMMUTABLE"
      " LANGUAGE sql RETURN " +
      std::to_string(oldest));
}

TEST_F(MigrateTest, NewerSchemaThatWasOnlyAddedToServes) {
  migrate(settings_for(*database));
  migrate_further(*database, required_schema_version());
  EXPECT_EQ(error_of_connecting(), "");
  EXPECT_THROW(migrate(settings_for(*database)), DatabaseError);
}

/// A program that was put back goes on with the schema's own functions, whatever they have become.
TEST_F(MigrateTest, NewerSchemaThatWasOnlyAddedToIsMaintained) {
  migrate(settings_for(*database));
  database->execute("SELECT loopscope.make_partitions('2020-02-15', 1)");
  const std::string newest =
      "'loopscope.verdict' || to_char(now() AT TIME ZONE 'UTC' + interval '1 month', '_YYYY_MM')";
  database->execute("DO $$ BEGIN EXECUTE 'DROP TABLE ' || " + newest + "; END $$");
  migrate_further(*database, required_schema_version());
  const MaintenanceResult result = maintain(settings_for(*database), {.retention_months = 24});
  EXPECT_EQ(result.created.size(), 1u);
  EXPECT_EQ(result.dropped.size(), 4u);
  EXPECT_EQ(database->value("SELECT to_regclass(" + newest + ") IS NOT NULL"), "t");
}

TEST_F(MigrateTest, NewerSchemaIsRefused) {
  migrate(settings_for(*database));
  migrate_further(*database, required_schema_version() + 1);
  EXPECT_THAT(error_of_connecting(), HasSubstr("newer than this program's"));
  EXPECT_THROW(migrate(settings_for(*database)), DatabaseError);
  EXPECT_THROW(maintain(settings_for(*database), {}), DatabaseError);
}

TEST_F(MigrateTest, OlderSchemaIsRefusedByTheWorker) {
  migrate(settings_for(*database));
  database->execute(
      "DELETE FROM loopscope.schema_migration WHERE version = (SELECT max(version)"
      " FROM loopscope.schema_migration)");
  EXPECT_THAT(error_of_connecting(), HasSubstr("run `loopscope migrate --config F` as the owner"));
}

TEST_F(MigrateTest, ChangedHistoryIsRefused) {
  migrate(settings_for(*database));
  database->execute("UPDATE loopscope.schema_migration SET sha256 = 'other' WHERE version = 102");
  try {
    migrate(settings_for(*database));
    FAIL();
  } catch (const DatabaseError& error) {
    EXPECT_THAT(error.what(), HasSubstr("applied with another text"));
  }
}

TEST_F(MigrateTest, FailureLeavesNothingBehind) {
  database->execute(
      "SET ROLE loopscope_owner; CREATE SCHEMA loopscope;"
      " CREATE TABLE loopscope.verdict (in_the_way int)");
  EXPECT_THROW(migrate(settings_for(*database)), DatabaseError);
  EXPECT_EQ(database->value("SELECT count(*) FROM pg_class WHERE relnamespace ="
                            " 'loopscope'::regnamespace"),
            "1");
}

/// One catalogue of verdicts: what SQL says of a code is what the program says.
TEST_F(MigrateTest, VerdictKindsAreTheProgramsCatalogue) {
  migrate(settings_for(*database));
  for (const core::diagnosis::CatalogueEntry& entry : core::diagnosis::catalogue()) {
    const std::string code = " WHERE code = '" + std::string(entry.name) + "'";
    const bool fault = entry.weight > 0.0;
    EXPECT_EQ(database->value("SELECT is_fault FROM loopscope.verdict_kind" + code),
              fault ? "t" : "f");
    EXPECT_EQ(database->value("SELECT meaning FROM loopscope.verdict_kind" + code), entry.meaning);
    EXPECT_EQ(database->value("SELECT coalesce(max(weight), 0) = " + std::to_string(entry.weight) +
                              " FROM loopscope.verdict_kind" + code),
              "t");
    EXPECT_EQ(
        database->value("SELECT coalesce(max(family), '') FROM loopscope.fault_family" + code),
        entry.family);
    EXPECT_EQ(
        database->value("SELECT pg_get_constraintdef(oid) LIKE '%''" + std::string(entry.name) +
                        "''%'"
                        " FROM pg_constraint WHERE conname = 'verdict_code_check'"
                        " AND conrelid = 'loopscope.verdict'::regclass"),
        "t");
  }
  EXPECT_EQ(database->value("SELECT count(*) FROM loopscope.verdict_kind"),
            std::to_string(core::diagnosis::catalogue().size()));
}

}  // namespace
}  // namespace loopscope::storage
