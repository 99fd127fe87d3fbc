#include <gmock/gmock.h>

#include "storage/results/plant/plant_rounds.hpp"
#include "storage/results/schema/embedded_migrations.hpp"
#include "storage/results/schema/migrate.hpp"
#include "tests/storage/results/upgrade_fixture.hpp"

/// What becomes of a database of the former chain of migrations.
namespace loopscope::storage {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr const char* kRecorded =
    "SELECT version, name, sha256 FROM loopscope.schema_migration ORDER BY version";

std::string refusal_of(const ConnectionSettings& as_owner) {
  try {
    migrate(as_owner);
  } catch (const DatabaseError& error) {
    EXPECT_EQ(error.remedy(), Remedy::give_up);
    return std::string(error.what()) + " HINT: " + error.hint();
  }
  return "";
}

TEST_F(UpgradeTest, KeepsEveryRowAndServesTheNewProgram) {
  database->execute(kStay);
  before = contents();
  const std::string listed = "SELECT row(list.*)::text FROM loopscope.flagged_loop AS list";
  const std::string hidden = "SELECT row(loop.*)::text FROM loopscope.hidden_loop AS loop";
  const TextRows list = database->rows(listed), off_the_list = database->rows(hidden);
  EXPECT_THAT(list, SizeIs(2));
  const ConnectionSettings as_owner = settings_for(*database, owner);
  EXPECT_THAT(migrate(as_owner), SizeIs(embedded_migrations().size()));
  EXPECT_EQ(contents(), before);
  EXPECT_EQ(database->rows(listed), list);
  EXPECT_EQ(database->rows(hidden), off_the_list);
  EXPECT_THAT(migrate(as_owner), IsEmpty());
  ResultsDatabase results(settings_for(*database, worker));
  EXPECT_EQ(results.claim_due("host/2/0", 60, 10).size(), 2U);
  EXPECT_EQ(PlantRounds(settings_for(*database, worker)).take_turn(0, "host/2", 60).wait_s, 0.0);
  EXPECT_NO_THROW(static_cast<void>(maintain(as_owner, {.retention_months = 12})));
}

TEST_F(UpgradeTest, ItsRowsOfTheChainAreExchanged) {
  migrate(settings_for(*database, owner));
  TextRows expected;
  for (const Migration& migration : embedded_migrations())
    expected.push_back({std::to_string(migration.number), migration.name, migration.sha256});
  EXPECT_EQ(database->rows(kRecorded), expected);
}

TEST_F(UpgradeTest, MonthsThatMaintainHadMadeCanBeReadAfterwards) {
  migrate(settings_for(*database, owner));
  EXPECT_EQ(tests::SqlConnection(database->conninfo(reader))
                .run("SELECT count(*) FROM loopscope.analysis_2026_01"),
            (TextRows{{"2"}}));
}

/// A site's own view on ours, and a right that was given to a person, stay.
TEST_F(UpgradeTest, ViewsOfASiteAndRightsOfPersonsStay) {
  tests::TestDatabase& made = *database;
  const std::string person = made.make_login("");
  made.execute("CREATE VIEW public.ours AS SELECT loop_name, code FROM loopscope.latest_verdict");
  made.execute("GRANT SELECT ON loopscope.flagged_loop TO " + person);
  migrate(settings_for(made, owner));
  EXPECT_EQ(made.value("SELECT count(*) FROM public.ours"), "1");
  EXPECT_EQ(made.value("SELECT has_table_privilege('" + person +
                       "', 'loopscope.flagged_loop', 'SELECT')"),
            "t");
}

/// A superuser was given as owner, and nobody had run roles.sql.
TEST_F(UpgradeTest, ASuperusersSchemaIsGivenToTheGroupAsTheRunbookSays) {
  const tests::TestDatabase other;
  make_former_schema(other, "postgres");
  EXPECT_THROW(migrate(settings_for(other, "postgres")), DatabaseError);
  other.make_roles();
  const std::string runbook = tests::content_of(tests::source_dir() / "deploy" / "RUNBOOK.md");
  const std::string begin = "<<'SQL'\n";
  const std::size_t at = runbook.find(begin, runbook.find("## A schema that a superuser owns"));
  ASSERT_NE(at, std::string::npos);
  const std::size_t from = at + begin.size();
  other.execute(runbook.substr(from, runbook.find("\nSQL\n", from) - from));
  EXPECT_THAT(migrate(settings_for(other, owner)), SizeIs(embedded_migrations().size()));
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
  EXPECT_EQ(session.run("SELECT loopscope.oldest_program() <= 27")[0][0], "t");
  EXPECT_EQ(session.run("UPDATE loopscope.parameter SET value = 0.5 WHERE name = 'min_confidence'"
                        " RETURNING name"),
            (TextRows{{"min_confidence"}}));
  EXPECT_EQ(session.run("INSERT INTO loopscope.plant_round (slot_end, algorithm_revision, loops,"
                        " oscillating, events) VALUES ('2026-01-02', 1, 2, 0, 0) RETURNING loops"),
            (TextRows{{"2"}}));
  const tests::SqlConnection keeper(database->conninfo(owner));
  EXPECT_EQ(keeper.run("SELECT loopscope.delete_old_rows('-infinity')"), (TextRows{{""}}));
  EXPECT_EQ(keeper.run("SELECT loopscope.expired_partitions('-infinity')"), TextRows{});
}

TEST_F(UpgradeTest, AChainOfOtherWordsIsRefused) {
  database->execute("UPDATE loopscope.schema_migration SET sha256 = 'other' WHERE version = 2");
  EXPECT_THAT(refusal_of(settings_for(*database, owner)),
              HasSubstr("migration 0002_results was applied with another text"));
}

TEST_F(UpgradeTest, AChainThatWentOnIsRefused) {
  database->execute("INSERT INTO loopscope.schema_migration VALUES (28, '0028_other', 'x')");
  EXPECT_THAT(refusal_of(settings_for(*database, owner)),
              HasSubstr("migration 0028_other is not known to this program"));
}

/// From a version that the chain went through: refused, and left as it is.
class EarlierChainTest : public UpgradeTest, public testing::WithParamInterface<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(Versions, EarlierChainTest, testing::Values(15, 26));

TEST_P(EarlierChainTest, IsRefusedWithTheWayToGo) {
  tests::TestDatabase other;
  const std::string login = fill_former_schema(other, GetParam());
  const std::string objects =
      "SELECT string_agg(md5(pg_describe_object(classid, objid, 0)), ' ' ORDER BY objid)"
      " FROM pg_depend WHERE refobjid = 'loopscope'::regnamespace";
  const std::string rows = "SELECT row(schedule.*)::text FROM loopscope.schedule ORDER BY 1";
  const TextRows chain = other.rows(kRecorded), made = other.rows(objects), was = other.rows(rows);
  EXPECT_THAT(refusal_of(settings_for(other, login)),
              AllOf(HasSubstr("the schema has version " + std::to_string(GetParam()) +
                              ", and this program takes over version 27 only"),
                    HasSubstr("HINT: run `loopscope migrate --config F` of a program of schema"
                              " version 27 first")));
  EXPECT_EQ(other.rows(kRecorded), chain);
  EXPECT_EQ(other.rows(objects), made);
  EXPECT_EQ(other.rows(rows), was);
}

}  // namespace
}  // namespace loopscope::storage
