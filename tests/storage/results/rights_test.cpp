#include <algorithm>
#include <gmock/gmock.h>

#include "storage/results/schema/check_results.hpp"
#include "storage/results/schema/migrate.hpp"
#include "tests/storage/results/results_fixture.hpp"

namespace loopscope::storage {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Field;
using testing::HasSubstr;

/// A schema made by a login of the owner's group, as a site would do it.
class RightsTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!tests::test_server()) GTEST_SKIP() << tests::kNoServer;
    database = database_of_owner();
    database->make_roles();
    owner = database->make_login("loopscope_owner");
    worker = database->make_login("loopscope_worker");
    reader = database->make_login("loopscope_reader");
  }

  void expect_refused(const std::string& user, const std::string& sql) const {
    EXPECT_EQ(state_of(user, sql), "42501") << user << ": " << sql;
  }
  void expect_allowed(const std::string& user, const std::string& sql) const {
    EXPECT_EQ(state_of(user, sql), "") << user << ": " << sql;
  }

  /// A function runs the command as the user and throws its effect away.
  [[nodiscard]] std::string state_of(const std::string& user, const std::string& sql) const {
    database->execute(
        "CREATE OR REPLACE FUNCTION public.attempt(who text, command text) RETURNS text"
        " LANGUAGE plpgsql AS $f$ BEGIN"
        "   BEGIN EXECUTE format('SET LOCAL ROLE %I', who); EXECUTE command;"
        "   RAISE EXCEPTION USING ERRCODE = 'ZZZZZ';"
        "   EXCEPTION WHEN OTHERS THEN RETURN nullif(SQLSTATE, 'ZZZZZ'); END; END $f$");
    const std::string state =
        database->value("SELECT public.attempt($q$" + user + "$q$, $q$" + sql + "$q$)");
    return state == "NULL" ? "" : state;
  }

  std::unique_ptr<tests::TestDatabase> database;
  std::string owner, worker, reader;
};

TEST_F(RightsTest, OwnersGroupOwnsTheSchemaSoThatEveryMemberCanMaintainIt) {
  EXPECT_EQ(
      database->value("SELECT nspowner::regrole FROM pg_namespace WHERE nspname = 'loopscope'"),
      "loopscope_owner");
  const std::string second = database->make_login("loopscope_owner");
  EXPECT_TRUE(migrate(settings_for(*database, second)).empty());
  database->execute("SET ROLE loopscope_owner; SELECT loopscope.make_partitions('2020-01-01', 1)");
  EXPECT_EQ(maintain(settings_for(*database, second), {.retention_months = 12}).dropped.size(), 4u);
}

TEST_F(RightsTest, WorkerDoesItsWorkAndNoMore) {
  Catalogue(settings_for(*database, owner)).save(std::vector{loop_named("a"), loop_named("b")});
  ResultsDatabase results(settings_for(*database, worker));
  const std::vector<ClaimedLoop> claimed = results.claim_due("w", 60, 10);
  ASSERT_EQ(claimed.size(), 2u);
  const std::vector<FailedLoop> failed{{claimed[1].loop.loop_id, claimed[1].fence, "x", 1}};
  std::vector done{completed(claimed[0], slot(1), "d1")};
  done[0].problems.push_back({"op_constant", "", std::nullopt, std::nullopt});
  EXPECT_EQ(results.finish(done, failed).inserted, 1u);
  done[0].record->input_digest = "d1 late";
  EXPECT_EQ(results.finish(done, {}).revised, 1u);
  EXPECT_EQ(results.finish(std::vector{completed(claimed[0], slot(1), "d2")}, {}).revised, 1u);
  EXPECT_TRUE(results.extend(claimed, 60).empty());
  results.release(claimed);
  results.set_parameter("min_confidence", 0.5);
  EXPECT_EQ(Catalogue(settings_for(*database, worker)).list().size(), 2u);

  for (const char* sql :
       {"DELETE FROM loopscope.analysis", "DELETE FROM loopscope.verdict",
        "DELETE FROM loopscope.bicoherence_peak", "DELETE FROM loopscope.loop",
        "DELETE FROM loopscope.schedule", "TRUNCATE loopscope.verdict",
        "UPDATE loopscope.verdict SET confidence = 1", "UPDATE loopscope.loop SET enabled = false",
        "UPDATE loopscope.schedule SET enabled = false",
        "UPDATE loopscope.parameter SET description = ''",
        ("INSERT INTO loopscope.loop (name, source, pv_tag, period_s)"
         " VALUES ('x', 'y', 'z', 1)"),
        "INSERT INTO loopscope.schema_migration VALUES (99, 'x', 'x')",
        "INSERT INTO loopscope.annotation (loop_id, kind) VALUES (1, 'x')",
        "CREATE TABLE loopscope.mine (x int)", "ALTER TABLE loopscope.loop ADD COLUMN x int",
        "DROP TABLE loopscope.verdict_default", "SELECT loopscope.make_partitions(now(), 12)",
        "SELECT loopscope.drop_partition('verdict_default')", "SELECT loopscope.grant_rights()"}) {
    expect_refused(worker, sql);
  }
}

TEST_F(RightsTest, ReaderOnlyReads) {
  for (const char* view : {"latest_verdict",
                           "flagged_loop",
                           "loop_history",
                           "data_quality",
                           "before_after_maintenance",
                           "maintenance_window",
                           "maintenance_figure",
                           "figure_kind",
                           "fault_family",
                           "plant_oscillation_member",
                           "monitor_health",
                           "verdict_kind",
                           "verdict_cause",
                           "analysis",
                           "parameter",
                           "data_problem",
                           "revised_verdict",
                           "hidden_loop",
                           "flag_history",
                           "current_plant_oscillation",
                           "following_loop",
                           "own_verdict",
                           "annotation_history",
                           "annotation_in_force"}) {
    expect_allowed(reader, std::string("SELECT * FROM loopscope.") + view);
  }
  for (const char* sql :
       {"INSERT INTO loopscope.annotation (loop_id, kind) VALUES (1, 'x')",
        "UPDATE loopscope.parameter SET value = 0", "UPDATE loopscope.schedule SET owner = NULL",
        "DELETE FROM loopscope.analysis", "SELECT nextval('loopscope.analysis_id')",
        "CREATE TABLE loopscope.mine (x int)"}) {
    expect_refused(reader, sql);
  }
}

TEST_F(RightsTest, OthersSeeNothing) {
  const std::string stranger = database->make_login("");
  expect_refused(stranger, "SELECT * FROM loopscope.verdict");
  expect_refused(stranger, "SELECT loopscope.partitioned_tables()");
}

TEST_F(RightsTest, RoleThatIsMadeLaterGetsItsRightsWithTheNextMigrate) {
  database->execute(
      "REVOKE ALL ON ALL TABLES IN SCHEMA loopscope FROM loopscope_reader;"
      "REVOKE ALL ON SCHEMA loopscope FROM loopscope_reader");
  expect_refused(reader, "SELECT * FROM loopscope.latest_verdict");
  migrate(settings_for(*database, owner));
  expect_allowed(reader, "SELECT * FROM loopscope.latest_verdict");
}

TEST_F(RightsTest, ErrorsNameTheObjectAndTheWayOut) {
  try {
    Catalogue(settings_for(*database, worker)).save(std::vector{loop_named("x")});
    FAIL();
  } catch (const DatabaseError& error) {
    EXPECT_EQ(error.remedy(), Remedy::give_up);
    EXPECT_THAT(error.what(), HasSubstr("permission denied for table loop, statement save_loops"));
    EXPECT_THAT(error.hint(), HasSubstr("loopscope_owner"));
  }
  const std::string stranger = database->make_login("");
  try {
    const ResultsDatabase results(settings_for(*database, stranger));
    FAIL();
  } catch (const DatabaseError& error) {
    EXPECT_THAT(error.what(), HasSubstr("permission denied for schema loopscope"));
    EXPECT_THAT(error.hint(), HasSubstr("GRANT loopscope_worker TO " + stranger));
  }
}

TEST_F(RightsTest, MigratingWithoutTheRightSaysWhichScriptGivesIt) {
  tests::TestDatabase other;
  const std::string login = other.make_login("");
  try {
    migrate(settings_for(other, login));
    FAIL();
  } catch (const DatabaseError& error) {
    EXPECT_THAT(error.what(), HasSubstr("permission denied for database"));
    EXPECT_THAT(error.hint(), HasSubstr("deploy/roles.sql"));
  }
}

TEST_F(RightsTest, CheckFindsNothingToSayAboutAProperWorker) {
  for (const Finding& found : check_results(settings_for(*database, worker))) {
    EXPECT_TRUE(found.ok && !found.warning) << found.what;
    EXPECT_EQ(found.hint, "") << found.what;
  }
}

TEST_F(RightsTest, CheckFindsRightsThatAreMissingOrTooMany) {
  const auto missing = check_results(settings_for(*database, reader));
  EXPECT_THAT(missing,
              Contains(AllOf(Field(&Finding::ok, false),
                             Field(&Finding::what, HasSubstr("INSERT on loopscope.verdict")))));
  EXPECT_THAT(missing,
              Contains(AllOf(Field(&Finding::ok, true),
                             Field(&Finding::what,
                                   "the worker cannot CREATE in schema loopscope, as it should "
                                   "be"))));
  EXPECT_THAT(missing,
              Contains(Field(&Finding::what,
                             "the worker cannot DELETE from loopscope.loop, as it should be")));
  const auto many = check_results(settings_for(*database, owner));
  EXPECT_TRUE(std::ranges::all_of(many, &Finding::ok));
  EXPECT_THAT(many,
              Contains(AllOf(Field(&Finding::warning, true),
                             Field(&Finding::what, HasSubstr("DELETE on loopscope.verdict")))));
}

TEST_F(RightsTest, CheckFindsEachRightThatIsMissing) {
  for (const auto& [right, words] :
       {std::pair{"UPDATE (lost_leases) ON loopscope.schedule", "UPDATE on loopscope.schedule"},
        std::pair{"UPDATE (fence) ON loopscope.schedule", "UPDATE on loopscope.schedule"},
        std::pair{"INSERT ON loopscope.worker", "INSERT on loopscope.worker"},
        std::pair{"UPDATE (last_seen, held_loops, lost_leases, started_at, program_version,"
                  " algorithm_revision, left_at) ON loopscope.worker",
                  "UPDATE on loopscope.worker"},
        std::pair{"INSERT ON loopscope.flag_notice", "INSERT on loopscope.flag_notice"},
        std::pair{"EXECUTE ON FUNCTION loopscope.flagged_at",
                  "EXECUTE on function loopscope.flagged_at"},
        std::pair{"EXECUTE ON FUNCTION loopscope.oldest_program()",
                  "EXECUTE on function loopscope.oldest_program()"}}) {
    database->execute("REVOKE " + std::string(right) + " FROM loopscope_worker");
    const auto findings = check_results(settings_for(*database, worker));
    EXPECT_EQ(std::ranges::count_if(findings, [](const Finding& found) { return !found.ok; }), 1)
        << right;
    EXPECT_THAT(findings, Contains(AllOf(Field(&Finding::ok, false),
                                         Field(&Finding::what, HasSubstr(words)))));
    migrate(settings_for(*database, owner));
  }
}

TEST_F(RightsTest, CheckTurnsProblemsIntoFindings) {
  tests::TestDatabase empty;
  EXPECT_THAT(check_results(settings_for(empty)),
              Contains(AllOf(Field(&Finding::ok, false),
                             Field(&Finding::what, HasSubstr("not migrated yet")),
                             Field(&Finding::hint, HasSubstr("loopscope migrate")))));
  const std::string stranger = database->make_login("");
  EXPECT_THAT(check_results(settings_for(*database, stranger)),
              Contains(AllOf(Field(&Finding::ok, false),
                             Field(&Finding::what, HasSubstr("permission denied")))));
  EXPECT_THAT(check_results(settings_for(*database, "nobody_of_that_name")),
              Contains(Field(&Finding::what, HasSubstr("does not exist"))));
}

}  // namespace
}  // namespace loopscope::storage
