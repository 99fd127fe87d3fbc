#include <gmock/gmock.h>

#include "storage/results/catalogue/annotations.hpp"
#include "storage/results/catalogue/maintenance.hpp"
#include "storage/results/plant/plant_rounds.hpp"
#include "storage/results/reports/report_database.hpp"
#include "storage/results/schema/check_results.hpp"
#include "storage/results/schema/migrate.hpp"
#include "tests/storage/results/results_fixture.hpp"

namespace loopscope::storage {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Field;
using testing::HasSubstr;

/// Whose the schema is decides whether anything of it is executed. A squatter notes what he was
/// given to execute, and as whom.
class SchemaOwnerTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!tests::test_server()) GTEST_SKIP() << tests::kNoServer;
    database = std::make_unique<tests::TestDatabase>();
    database->execute("CREATE TABLE public.of_somebody (x int)");
    database->make_roles();
    outsider = database->make_login("");
    worker = database->make_login("loopscope_worker");
    owner = database->make_login("loopscope_owner");
    database->execute("GRANT CREATE ON DATABASE " + database->name() + " TO " + outsider +
                      "; CREATE SEQUENCE public.executed; GRANT ALL ON SEQUENCE public.executed"
                      " TO PUBLIC");
  }

  /// The outsider makes the schema first, with something of his own in the place of what every
  /// command begins with.
  void squat() const {
    tests::SqlConnection(database->conninfo(outsider)).run(R"(
      CREATE SCHEMA loopscope;
      GRANT ALL ON SCHEMA loopscope TO PUBLIC;
      CREATE FUNCTION loopscope.oldest_program() RETURNS integer LANGUAGE sql VOLATILE
        AS 'SELECT nextval(''public.executed'')::integer';
      CREATE VIEW loopscope.schema_migration AS
        SELECT loopscope.oldest_program() AS version, '' AS name, '' AS sha256;
      CREATE FUNCTION loopscope.make_partitions(timestamptz, integer) RETURNS SETOF text
        LANGUAGE sql AS 'SELECT loopscope.oldest_program()::text';
      GRANT SELECT ON loopscope.schema_migration TO PUBLIC)");
  }

  [[nodiscard]] bool executed() const {
    return database->value("SELECT is_called FROM public.executed") == "t";
  }

  [[nodiscard]] static std::string error_of(const std::function<void()>& command) {
    try {
      command();
      return "";
    } catch (const DatabaseError& error) {
      EXPECT_EQ(error.remedy(), Remedy::give_up);
      return std::string(error.what()) + " HINT: " + error.hint();
    }
  }

  /// What each of the program's connections says of the schema.
  [[nodiscard]] std::vector<std::string> errors_as(const std::string& user) const {
    const ConnectionSettings settings = settings_for(*database, user);
    return {error_of([&] { migrate(settings); }),
            error_of([&] { static_cast<void>(maintain(settings, {.retention_months = 24})); }),
            error_of([&] { const ResultsDatabase results(settings); }),
            error_of([&] { const Catalogue catalogue(settings); }),
            error_of([&] { const PlantRounds rounds(settings); }),
            error_of([&] { const ReportDatabase report(settings); }),
            error_of([&] { const Annotations annotations(settings); }),
            error_of([&] { const MaintenanceLog log(settings); })};
  }

  std::unique_ptr<tests::TestDatabase> database;
  std::string outsider, worker, owner;
};

TEST_F(SchemaOwnerTest, ASquattersSchemaIsRefusedBeforeAnythingOfItIsExecuted) {
  squat();
  for (const std::string& user : {std::string("postgres"), owner, worker}) {
    for (const std::string& error : errors_as(user)) {
      EXPECT_THAT(error, HasSubstr("the schema loopscope belongs to " + outsider)) << user;
      EXPECT_THAT(error, HasSubstr("HINT: nothing of it was executed")) << user;
    }
  }
  EXPECT_FALSE(executed());
  EXPECT_THAT(check_results(settings_for(*database)),
              Contains(AllOf(Field(&Finding::ok, false),
                             Field(&Finding::what, HasSubstr("belongs to " + outsider)))));
}

/// Whatever stands in the schema could make its maker a superuser, whichever role the session took.
TEST_F(SchemaOwnerTest, ASuperuserIsRefusedBeforeAnythingIsExecuted) {
  migrate(settings_for(*database, owner));
  const tests::SqlConnection plotter(database->conninfo(owner));
  plotter.run(
      "SET ROLE loopscope_owner;"
      "CREATE FUNCTION loopscope.plot() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN"
      " RESET ROLE; PERFORM nextval('public.executed'); RETURN NULL; END $$;"
      "CREATE TRIGGER plot AFTER INSERT OR UPDATE ON loopscope.parameter"
      " EXECUTE FUNCTION loopscope.plot();"
      "CREATE OR REPLACE FUNCTION loopscope.oldest_program() RETURNS integer LANGUAGE plpgsql"
      " AS $$ BEGIN RESET ROLE; PERFORM nextval('public.executed'); RETURN 1; END $$");
  for (const std::string& error : errors_as("postgres")) {
    EXPECT_THAT(error, AllOf(HasSubstr("the login postgres of the results database is a superuser"),
                             HasSubstr("HINT: nothing of the schema was executed"),
                             HasSubstr("member of loopscope_owner")));
  }
  EXPECT_THAT(check_results(settings_for(*database, "postgres")),
              Contains(AllOf(Field(&Finding::ok, false),
                             Field(&Finding::what, HasSubstr("is a superuser")))));
  EXPECT_FALSE(executed());
}

/// Such a one is a superuser as soon as a function of the schema says SET ROLE.
TEST_F(SchemaOwnerTest, AMemberOfASuperuserIsRefused) {
  migrate(settings_for(*database, owner));
  const std::string administrator = database->make_login("loopscope_owner");
  database->execute("GRANT postgres TO " + administrator);
  for (const std::string& error : errors_as(administrator))
    EXPECT_THAT(error, HasSubstr("the login " + administrator +
                                 " of the results database is a"
                                 " member of the superuser postgres"));
}

/// A function of the schema could take it back by RESET SESSION AUTHORIZATION.
TEST_F(SchemaOwnerTest, ASuperuserThatAnOptionHidesIsRefused) {
  migrate(settings_for(*database, owner));
  ConnectionSettings settings = settings_for(*database, "postgres");
  settings.conninfo += " options='-c session_authorization=" + owner + "'";
  EXPECT_THAT(error_of([&] { migrate(settings); }),
              HasSubstr("the login postgres of the results database is a superuser"));
}

TEST_F(SchemaOwnerTest, ASuperuserWhoOwnsTheSchemaIsToldToGiveItAway) {
  database->execute("CREATE SCHEMA loopscope");
  for (const std::string& error : errors_as("postgres")) {
    EXPECT_THAT(error, AllOf(HasSubstr("is a superuser"), HasSubstr("belongs to postgres"),
                             HasSubstr("RUNBOOK, A schema that a superuser owns")));
  }
}

TEST_F(SchemaOwnerTest, CheckNamesTheOwner) {
  migrate(settings_for(*database, owner));
  EXPECT_THAT(check_results(settings_for(*database, worker)),
              Contains(AllOf(Field(&Finding::ok, true), Field(&Finding::warning, false),
                             Field(&Finding::what,
                                   "the schema loopscope belongs to"
                                   " loopscope_owner"))));
}

/// roles.sql was run in another database: the login that migrates becomes the owner.
TEST_F(SchemaOwnerTest, ASchemaOfAMemberOfTheGroupIsTrusted) {
  const tests::TestDatabase other;
  other.execute("GRANT CREATE ON DATABASE " + other.name() + " TO " + owner);
  migrate(settings_for(other, owner));
  EXPECT_EQ(other.value("SELECT nspowner::regrole FROM pg_namespace WHERE nspname = 'loopscope'"),
            owner);
  EXPECT_NO_THROW(ResultsDatabase(settings_for(other, worker)));
  EXPECT_NO_THROW(migrate(settings_for(other, owner)));
}

}  // namespace
}  // namespace loopscope::storage
