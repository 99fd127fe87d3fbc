#include <gmock/gmock.h>

#include "storage/results/schema/embedded_migrations.hpp"
#include "storage/results/schema/migrate.hpp"
#include "tests/storage/results/upgrade_fixture.hpp"

/// A filled schema of a version before, of today's chain, and programs of that version beside it.
namespace loopscope::storage {
namespace {

using testing::IsEmpty;

class EarlierSchema : public UpgradeTest {
 protected:
  /// As `migrate` of a program of that version left it, with the rows of UpgradeTest and kStay.
  void make(tests::TestDatabase& made, int version) {
    made.make_roles();
    login = made.make_login("loopscope_owner");
    engineer = made.make_login("loopscope_engineer");
    std::string script = "SET ROLE loopscope_owner; CREATE SCHEMA loopscope;";
    for (const Migration& migration : embedded_migrations()) {
      if (migration.number > version) break;
      script += migration.sql;
      script += "INSERT INTO loopscope.schema_migration VALUES (" +
                std::to_string(migration.number) + ", '" + migration.name + "', '" +
                migration.sha256 + "');";
    }
    made.execute(script +
                 "SELECT loopscope.make_partitions(now(), 4); SELECT loopscope.grant_rights();"
                 "SELECT loopscope.make_partitions('2026-01-01', 1)");
    made.execute(kRows);
    made.execute(kStay);
    made.execute(
        "INSERT INTO loopscope.maintenance_event (loop_id, done_at, kind, description)"
        " SELECT loop_id, '2026-01-01', 'valve', 'packing' FROM loopscope.loop WHERE name = 'a'");
  }
  std::string login, engineer;
};

/// The columns that a view of the version before had, in their order.
TextRows columns_of_views(const tests::TestDatabase& database) {
  return database.rows(
      "SELECT relname, attnum, attname FROM pg_class JOIN pg_attribute ON attrelid = pg_class.oid"
      " WHERE relnamespace = 'loopscope'::regnamespace AND relkind = 'v' AND attnum > 0"
      " ORDER BY 1, attnum");
}

TEST_F(EarlierSchema, KeepsEveryRowAndTheOrderOfItsColumns) {
  for (const auto& [version, next] :
       {std::pair{106, "0107_names_and_totals"}, {108, "0109_runs"}, {109, "0110_hidden_loops"}}) {
    tests::TestDatabase made;
    make(made, version);
    const std::string said =
        "SELECT row(annotation_id, loop_id, kind, code, until, reason, author, entered_at,"
        " withdrawn_at, withdrawn_by)::text FROM loopscope.annotation ORDER BY annotation_id";
    const std::string work =
        "SELECT row(maintenance_event_id, loop_id, done_at, kind, description, author,"
        " entered_at)::text FROM loopscope.maintenance_event";
    const std::string list = "SELECT row(list.*)::text FROM loopscope.flagged_loop AS list";
    const std::string off_the_list =
        "SELECT loop_name, hidden_by, cause, probability::text FROM loopscope.hidden_loop"
        " ORDER BY 1, 2";
    const TextRows hidden = made.rows(off_the_list);
    const TextRows annotations = made.rows(said), events = made.rows(work),
                   listed = made.rows(list);
    const TextRows columns = columns_of_views(made);
    EXPECT_EQ(migrate(settings_for(made, login)).front(), next);
    EXPECT_EQ(made.rows(said), annotations);
    EXPECT_EQ(made.rows(work), events);
    EXPECT_EQ(made.rows(list), listed);
    EXPECT_EQ(made.rows(off_the_list), hidden);
    const TextRows after = columns_of_views(made);
    for (const auto& column : columns)
      EXPECT_THAT(after, testing::Contains(column)) << column[0] << '.' << column[2];
    EXPECT_THAT(made.rows("SELECT 1 FROM loopscope.annotation WHERE on_behalf_of IS NOT NULL"),
                IsEmpty());
    EXPECT_EQ(made.rows("SELECT code, announced FROM loopscope.flag_total"),
              (TextRows{{"valve_stiction", "1"}}));
  }
}

/// The statements of a program of version 106, by the logins that it has.
TEST_F(EarlierSchema, ProgramsOfVersion106GoOnBesideTheNewOne) {
  tests::TestDatabase made;
  make(made, 106);
  migrate(settings_for(made, login));
  const tests::SqlConnection session(made.conninfo(engineer));
  EXPECT_EQ(session.run("SELECT loopscope.oldest_program() <= 106")[0][0], "t");
  session.run(
      "INSERT INTO loopscope.annotation (loop_id, kind, code, until, reason)"
      " SELECT loop_id, 'false_positive', NULL, NULL, 'x' FROM loopscope.loop WHERE name = 'a'");
  EXPECT_EQ(session.run("UPDATE loopscope.annotation AS said SET withdrawn_at = now()"
                        " FROM loopscope.annotation_in_force AS holds"
                        " WHERE holds.annotation_id = said.annotation_id AND holds.loop_name = 'a'"
                        " RETURNING withdrawn_by, withdrawn_on_behalf_of"),
            (TextRows{{engineer, "NULL"}}));
  session.run(
      "INSERT INTO loopscope.maintenance_event (loop_id, done_at, kind, description)"
      " SELECT loop_id, now(), 'valve', 'packing' FROM loopscope.loop WHERE name = 'b'");
  // Its announcements count, too: by a trigger.
  const tests::SqlConnection announcer(made.conninfo(made.make_login("loopscope_worker")));
  announcer.run(
      "WITH came AS (INSERT INTO loopscope.flag_notice (loop_id, code, announced, slot_end, since,"
      " status, confidence, rank, score, summary) SELECT loop_id, 'valve_deadband', name <> 'off',"
      " now(), now(), 'watch', 1, 1, 1, '' FROM loopscope.loop RETURNING 1) SELECT count(*)"
      " FROM came");
  EXPECT_EQ(made.rows("SELECT code, announced FROM loopscope.flag_total ORDER BY code"),
            (TextRows{{"valve_deadband", "2"}, {"valve_stiction", "1"}}));
}

}  // namespace
}  // namespace loopscope::storage
