#include <gmock/gmock.h>

#include "storage/results/plant/plant_rounds.hpp"
#include "storage/results/schema/migrate.hpp"
#include "tests/storage/results/upgrade_fixture.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::storage {
namespace {

using testing::IsEmpty;

/// list_false_share, of schema 22; list_leave_share and list_enough_windows, of 24;
/// list_least_probability, of 25; list_leave_probability, of 26. Schemas 27 and 28 have none.
std::size_t new_parameters(int former) {
  if (former < 22) return 5;
  if (former < 24) return 4;
  if (former < 25) return 2;
  return former < 26 ? 1 : 0;
}

/// From each version that a program was given out with.
class UpgradeFromTest : public UpgradeTest, public testing::WithParamInterface<int> {
 protected:
  UpgradeFromTest() : UpgradeTest(GetParam()) {}
};
INSTANTIATE_TEST_SUITE_P(Versions, UpgradeFromTest,
                         testing::Values(15, 17, 18, 19, 20, 21, 22, 24, 25, 26, 27));

TEST_P(UpgradeFromTest, KeepsEveryRowAndServesTheNewProgram) {
  const ConnectionSettings as_owner = settings_for(*database, owner);
  EXPECT_EQ(static_cast<int>(migrate(as_owner).size()), required_schema_version() - former);
  const TextRows after = contents();
  EXPECT_THAT(after, testing::IsSupersetOf(before));
  EXPECT_EQ(after.size(), before.size() + new_parameters(former));
  EXPECT_THAT(migrate(as_owner), IsEmpty());
  ResultsDatabase results(settings_for(*database, worker));
  EXPECT_EQ(results.claim_due("host/2/0", 60, 10).size(), 2U);
  EXPECT_EQ(PlantRounds(settings_for(*database, worker)).take_turn(0, "host/2", 60).wait_s, 0.0);
  EXPECT_NO_THROW(static_cast<void>(maintain(as_owner, {})));
}

/// Of a step that was stored before nobody knows what asked for it: null, which is not "none did".
TEST_P(UpgradeFromTest, StepsOfBeforeClaimNothingOfWhatAskedForThem) {
  migrate(settings_for(*database, owner));
  EXPECT_EQ(database->rows("SELECT count(*), count(asked_by) FROM loopscope.explanation_step"),
            (TextRows{{"4", "0"}}));
  EXPECT_EQ(database->rows("SELECT count(*), count(asked_by) FROM loopscope.explanation"),
            (TextRows{{"2", "0"}}));
  EXPECT_THAT(
      database->value("SELECT string_agg(DISTINCT left(col_description(attrelid, attnum), 14), '|')"
                      " FROM pg_attribute WHERE attname = 'asked_by' AND attrelid IN (SELECT"
                      " inhrelid FROM pg_inherits WHERE inhparent ="
                      " 'loopscope.explanation_step'::regclass)"),
      testing::StrEq("Residual tests"))
      << "in every partition";
}

/// Nobody weighed causes before: no row, and none of the verdicts is touched.
TEST_P(UpgradeFromTest, VerdictsOfBeforeHaveNoCauses) {
  migrate(settings_for(*database, owner));
  EXPECT_EQ(database->rows("SELECT count(*), count(cause_probabilities) FROM loopscope.verdict"),
            (TextRows{{"2", "0"}}));
  EXPECT_EQ(database->value("SELECT count(*) FROM loopscope.verdict_cause"), "0");
}

/// Before, each of these values stopped every claim.
TEST_F(UpgradeTest, RowsThatSomebodyHasSpoiltAreMended) {
  for (const char* const spoilt :
       {"fence = 9223372036854775807", "fence = -5", "attempts = 2147483647", "lost_leases = -1",
        "last_slot_end = 'infinity'", "result_slot_end = '294276-12-31'"}) {
    database->execute("UPDATE loopscope.schedule SET " + std::string(spoilt) +
                      " WHERE loop_id = (SELECT loop_id FROM loopscope.loop WHERE name = 'b')");
  }
  migrate(settings_for(*database, owner));
  ResultsDatabase results(settings_for(*database, worker));
  EXPECT_EQ(results.claim_due("host/2/0", 60, 10).size(), 2U);
  EXPECT_EQ(database->rows("SELECT attempts, lost_leases, last_slot_end, result_slot_end"
                           " FROM loopscope.schedule JOIN loopscope.loop USING (loop_id)"
                           " WHERE name = 'b'"),
            (TextRows{{"1000000", "0", "NULL", "NULL"}}));
}

TEST_F(UpgradeTest, MonthsThatMaintainHadMadeCanBeReadAfterwards) {
  const std::string month = "SELECT count(*) FROM loopscope.analysis_2026_01";
  const tests::SqlConnection session(database->conninfo(reader));
  EXPECT_THROW(session.run(month), std::runtime_error);
  migrate(settings_for(*database, owner));
  EXPECT_EQ(tests::SqlConnection(database->conninfo(reader)).run(month), (TextRows{{"2"}}));
}

/// A superuser was given as owner, and nobody had run roles.sql.
TEST_F(UpgradeTest, ASuperusersSchemaIsGivenToTheGroupAsTheRunbookSays) {
  const tests::TestDatabase other;
  make_former_schema(other, "postgres", former);
  EXPECT_THROW(migrate(settings_for(other, "postgres")), DatabaseError);
  other.make_roles();
  const std::string runbook = tests::content_of(tests::source_dir() / "deploy" / "RUNBOOK.md");
  const std::string begin = "<<'SQL'\n";
  const std::size_t at = runbook.find(begin, runbook.find("## A schema that a superuser owns"));
  ASSERT_NE(at, std::string::npos);
  const std::size_t from = at + begin.size();
  other.execute(runbook.substr(from, runbook.find("\nSQL\n", from) - from));
  EXPECT_EQ(static_cast<int>(migrate(settings_for(other, owner)).size()),
            required_schema_version() - former);
  EXPECT_THAT(other.rows("SELECT oid::regclass::text FROM pg_class WHERE relnamespace ="
                         " 'loopscope'::regnamespace AND relowner <> 'loopscope_owner'::regrole"
                         " UNION ALL SELECT oid::regproc::text FROM pg_proc WHERE pronamespace ="
                         " 'loopscope'::regnamespace AND proowner <> 'loopscope_owner'::regrole"),
              IsEmpty());
  EXPECT_NO_THROW(
      static_cast<void>(maintain(settings_for(other, owner), {.retention_months = 12})));
}

/// `oldest_program` promises it: workers follow one by one.
TEST_F(UpgradeTest, TheFormerProgramsStatementsStillWork) {
  migrate(settings_for(*database, owner));
  const tests::SqlConnection session(database->conninfo(worker));
  EXPECT_EQ(session.run("SELECT loopscope.oldest_program() <= 15")[0][0], "t");
  EXPECT_EQ(session.run("UPDATE loopscope.parameter SET value = 0.5 WHERE name = 'min_confidence'"
                        " RETURNING name"),
            (TextRows{{"min_confidence"}}));
  EXPECT_EQ(session.run("SELECT pg_try_advisory_lock(1819242352, 1)"), (TextRows{{"t"}}));
  EXPECT_EQ(session.run("INSERT INTO loopscope.plant_round (slot_end, algorithm_revision, loops,"
                        " oscillating, events) VALUES ('2026-01-02', 1, 2, 0, 0) RETURNING loops"),
            (TextRows{{"2"}}));
}

}  // namespace
}  // namespace loopscope::storage
