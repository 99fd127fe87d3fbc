#include <gmock/gmock.h>

#include "storage/results/embedded_migrations.hpp"
#include "storage/results/migrate.hpp"
#include "storage/results/plant_rounds.hpp"
#include "tests/storage/results/results_fixture.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::storage {
namespace {

using testing::IsEmpty;

/// A schema of an earlier version, in use: what a later migration changes is changed under rows,
/// partitions and rights that are there.
class UpgradeTest : public testing::Test {
 protected:
  explicit UpgradeTest(int from = 15) : former(from) {}

  void SetUp() override {
    if (!tests::test_server()) GTEST_SKIP() << tests::kNoServer;
    database = std::make_unique<tests::TestDatabase>();
    database->make_roles();
    owner = database->make_login("loopscope_owner");
    worker = database->make_login("loopscope_worker");
    reader = database->make_login("loopscope_reader");
    make_former_schema(*database, "loopscope_owner", former);
    database->execute(kRows);
    for (const char* table : {"loop", "schedule", "analysis", "verdict", "annotation",
                              "plant_round", "parameter", "explanation_step"})
      selects.push_back(database->value(
          std::string(
              "SELECT 'SELECT row(' || string_agg(attname, ', ' ORDER BY attnum) || ')::text"
              " FROM ' || attrelid::regclass || ' ORDER BY 1' FROM pg_attribute WHERE"
              " attnum > 0 AND attrelid = 'loopscope.") +
          table + "'::regclass GROUP BY attrelid"));
    before = contents();
  }

  /// As `migrate` of that version left it.
  static void make_former_schema(const tests::TestDatabase& made, const std::string& by,
                                 int version) {
    std::string script = "SET ROLE " + by + ";";
    for (const Migration& migration :
         embedded_migrations().first(static_cast<std::size_t>(version))) {
      script += migration.sql;
      script += "INSERT INTO loopscope.schema_migration VALUES (" +
                std::to_string(migration.number) + ", '" + migration.name + "', '" +
                migration.sha256 + "');";
    }
    made.execute(script +
                 "SELECT loopscope.make_partitions(now(), 4); SELECT loopscope.grant_rights();"
                 // By `maintain`, which granted nothing.
                 "SELECT loopscope.make_partitions('2026-01-01', 1)");
  }

  /// Two loops, one held by a worker, with a verdict, and an annotation of each state.
  static constexpr const char* kRows = R"(
    SET ROLE loopscope_owner;
    INSERT INTO loopscope.loop (name, source, pv_tag, period_s, enabled)
      VALUES ('a', 'plant', 'a.PV', 3600, true), ('b', 'plant', 'b.PV', 3600, true),
             ('off', 'plant', 'off.PV', 3600, false);
    INSERT INTO loopscope.analysis (loop_id, slot_end, algorithm_revision, analysis_id, fence,
        program_version, settings, input_digest, fetch_ms, analyse_ms, window_start, window_end,
        samples, interval_s, usable, flags, oscillating)
      SELECT loop_id, '2026-01-01 01:00:00+00', 1, nextval('loopscope.analysis_id'), 1, '0.1.0', '{}',
             'd', 1, 1, '2026-01-01 00:00:00+00', '2026-01-01 01:00:00+00', 4096, 1, true, '{}', false
      FROM loopscope.loop WHERE enabled;
    INSERT INTO loopscope.verdict (loop_id, slot_end, algorithm_revision, input_revision, analysis_id,
        code, confidence, summary, reasons, action)
      SELECT loop_id, slot_end, 1, 1, analysis_id, 'valve_stiction', 0.9, 'sticks', '{}', 'stroke it'
      FROM loopscope.analysis;
    INSERT INTO loopscope.explanation_step (loop_id, slot_end, algorithm_revision, input_revision,
        step, effect, parameters, intervals, holdout_error_before, holdout_error_after, statement)
      SELECT loop_id, slot_end, 1, 1, number, 'valve_stiction', '{"S": 4.2}', '{}', 1, 0.25, 'It sticks.'
      FROM loopscope.analysis CROSS JOIN generate_series(1, 2) AS number;
    UPDATE loopscope.schedule SET owner = 'host/1/0', fence = 1, attempts = 2, lost_leases = 1,
        visible_at = now() - interval '1 s', last_slot_end = '2026-01-01 01:00:00+00',
        result_slot_end = '2026-01-01 01:00:00+00'
      WHERE loop_id = (SELECT loop_id FROM loopscope.loop WHERE name = 'a');
    INSERT INTO loopscope.annotation (loop_id, kind, withdrawn_at)
      SELECT loop_id, 'acknowledged', CASE name WHEN 'a' THEN now() END FROM loopscope.loop
      WHERE enabled;
    INSERT INTO loopscope.plant_round VALUES ('2026-01-01 01:00:00+00', 1, 2, 0, 0, now());
    UPDATE loopscope.parameter SET value = 0.4 WHERE name = 'min_confidence')";

  /// Loop a is on the list, loop b would be.
  static constexpr const char* kStay = R"(
    UPDATE loopscope.annotation SET withdrawn_at = now() WHERE withdrawn_at IS NULL;
    UPDATE loopscope.schedule SET result_slot_end = '2026-01-01 01:00:00+00';
    INSERT INTO loopscope.flag_notice (loop_id, code, announced, slot_end, since, status, confidence, rank, score, summary)
      SELECT loop_id, code, true, slot_end, slot_end, 'watch', 0.9, 1, 0.5, 'sticks' FROM loopscope.verdict
      WHERE loop_id = (SELECT loop_id FROM loopscope.loop WHERE name = 'a'))";

  /// In the columns that there were.
  [[nodiscard]] TextRows contents() const {
    TextRows rows;
    for (const std::string& select : selects) {
      for (const auto& row : database->rows(select)) rows.push_back(row);
    }
    return rows;
  }

  int former;
  std::unique_ptr<tests::TestDatabase> database;
  std::string owner, worker, reader;
  std::vector<std::string> selects;
  TextRows before;
};

/// list_false_share, of schema 22; list_leave_share and list_enough_windows, of 24;
/// list_least_probability, of 25.
std::size_t new_parameters(int former) {
  if (former < 22) return 4;
  return former < 24 ? 3 : 1;
}

/// From each version that a program was given out with.
class UpgradeFromTest : public UpgradeTest, public testing::WithParamInterface<int> {
 protected:
  UpgradeFromTest() : UpgradeTest(GetParam()) {}
};
INSTANTIATE_TEST_SUITE_P(Versions, UpgradeFromTest,
                         testing::Values(15, 17, 18, 19, 20, 21, 22, 24));

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

/// A filled schema 21: what was weighed stays, nothing is combined, and the list goes by the
/// window.
TEST_F(UpgradeTest, WindowsOfSchema21StayAndAreListedByTheirOwnProbability) {
  tests::TestDatabase other;
  other.make_roles();
  make_former_schema(other, "loopscope_owner", 21);
  other.execute(kRows);
  other.execute("UPDATE loopscope.verdict SET cause_probabilities = '{0.01,0.9}'");
  other.execute("UPDATE loopscope.annotation SET withdrawn_at = now() WHERE withdrawn_at IS NULL");
  const std::string rows =
      "SELECT row(loop_id, slot_end, algorithm_revision, input_revision, code, confidence,"
      " cause_probabilities)::text FROM loopscope.verdict ORDER BY 1";
  const TextRows verdicts = other.rows(rows);
  migrate(settings_for(other, other.make_login("loopscope_owner")));
  EXPECT_EQ(other.rows(rows), verdicts);
  EXPECT_EQ(other.rows("SELECT count(*), count(combined_probabilities), count(combined_evidence)"
                       " FROM loopscope.analysis"),
            (TextRows{{"2", "0", "0"}}));
  EXPECT_EQ(other.rows("SELECT loop_name, combined_confidence, round(fault_probability::numeric, 2)"
                       " FROM loopscope.flagged_loop"),
            (TextRows{{"a", "NULL", "0.99"}}))
      << "loop b has not been given back: no newest slot";
  EXPECT_EQ(other.value("SELECT count(*) FROM pg_attribute WHERE attname = 'combined_windows' AND"
                        " col_description(attrelid, attnum) IS NULL"),
            "0");
}

/// A filled schema 22 with a loop on its list: the stay goes on, and leaves at the looser rate.
TEST_F(UpgradeTest, StaysOfSchema22GoOn) {
  tests::TestDatabase other;
  other.make_roles();
  make_former_schema(other, "loopscope_owner", 22);
  other.execute(kRows);
  other.execute("UPDATE loopscope.verdict SET cause_probabilities = '{0.01,0.9}'");
  other.execute(kStay);
  const std::string notices = "SELECT row(notice.*)::text FROM loopscope.flag_notice AS notice";
  const TextRows before_it = other.rows(notices);
  migrate(settings_for(other, other.make_login("loopscope_owner")));
  EXPECT_EQ(other.rows(notices), before_it);
  EXPECT_EQ(other.rows("SELECT loop_name, area, owner FROM loopscope.flagged_loop ORDER BY 1"),
            (TextRows{{"a", "NULL", "NULL"}, {"b", "NULL", "NULL"}}));
  other.execute("UPDATE loopscope.verdict SET cause_probabilities = '{0.15,0.8}'");
  EXPECT_EQ(other.rows("SELECT loop_name FROM loopscope.flagged_loop"), (TextRows{{"a"}}));
  EXPECT_EQ(other.rows("SELECT loop_name, hidden_by FROM loopscope.hidden_loop"),
            (TextRows{{"b", "probability"}}));
  EXPECT_EQ(other.value("SELECT count(*) FROM loopscope.service_factor"), "0")
      << "nobody looked at modes before";
  EXPECT_EQ(other.rows("SELECT count(*), count(control_fraction) FROM loopscope.analysis"),
            (TextRows{{"2", "0"}}));
}

/// A filled schema 24 with a loop on its list: the stay goes on with a probability that no loop
/// enters with any more.
TEST_F(UpgradeTest, StaysOfSchema24GoOn) {
  tests::TestDatabase other;
  other.make_roles();
  make_former_schema(other, "loopscope_owner", 24);
  other.execute(kRows);
  other.execute(kStay);
  other.execute(
      "UPDATE loopscope.verdict SET cause_probabilities = '{0.25,0.75}';"
      "UPDATE loopscope.parameter SET value = 0.3"
      " WHERE name IN ('list_false_share', 'list_leave_share')");
  const std::string list = "SELECT loop_name FROM loopscope.flagged_loop ORDER BY 1";
  EXPECT_EQ(other.rows(list), (TextRows{{"a"}, {"b"}}));
  migrate(settings_for(other, other.make_login("loopscope_owner")));
  EXPECT_EQ(other.rows(list), (TextRows{{"a"}}));
  EXPECT_EQ(other.rows("SELECT loop_name, hidden_by, reason FROM loopscope.hidden_loop"),
            (TextRows{{"b", "probability", "not sure enough for the list (probability 0.75)"}}));
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
