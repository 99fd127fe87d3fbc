#include "tests/storage/results/documented_rights.hpp"

#include <gmock/gmock.h>

#include "storage/results/schema/migrate.hpp"
#include "tests/storage/results/role_fixture.hpp"

namespace loopscope::storage {
namespace {

using testing::IsEmpty;
using tests::LoginSession;

/// What storage/README.md does not list has to be refused, and what it lists has to be allowed.
class DocumentedRightsTest : public RoleTest {
 protected:
  /// Role and login.
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> everybody() const {
    return {{"worker", worker},
            {"reader", reader},
            {"engineer", engineer},
            {"historian", historian},
            {"stranger", stranger}};
  }
};

TEST_F(DocumentedRightsTest, EveryTableOfTheSchemaIsReadAndWrittenAsDocumentedAndNoOtherWay) {
  // Months that are younger than the last migrate.
  ASSERT_EQ(
      database->rows("SET ROLE loopscope_owner; SELECT loopscope.make_partitions('2020-01-01', 1)")
          .size(),
      4U);
  for (const auto& [role, user] : everybody()) {
    SCOPED_TRACE(role);
    const DocumentedRights rights(role);
    const LoginSession session = log_in(user);
    for (const auto& relation : relations("loopscope")) {
      const std::string name = "loopscope." + relation[0];
      const bool view = relation[1] == "t";
      // Partitions are written through their tables; read by themselves too, as pg_dump does.
      expect_state(session, "TABLE " + name, rights.on_table("SELECT", relation[0]));
      expect_state(session, "INSERT INTO " + name + " DEFAULT VALUES",
                   rights.on_table("INSERT", relation[0]));
      expect_state(session, "DELETE FROM " + name, false);
      for (const std::string& command : ddl_on(name, view)) expect_state(session, command, false);
    }
  }
}

TEST_F(DocumentedRightsTest, EveryColumnIsWrittenAsDocumentedAndNoOther) {
  for (const auto& [role, user] :
       {std::pair{"worker", worker}, {"reader", reader}, {"engineer", engineer}}) {
    const DocumentedRights rights(role);
    const LoginSession session = log_in(user);
    for (const auto& relation : relations("loopscope")) {
      for (const std::string& column : columns("loopscope." + relation[0])) {
        const std::string name = "loopscope." + relation[0];
        expect_state(session, "UPDATE " + name + " SET " + column + " = DEFAULT WHERE false",
                     rights.update_of(relation[0], column));
        expect_state(session, "INSERT INTO " + name + " (" + column + ") VALUES (DEFAULT)",
                     rights.insert_of(relation[0], column));
      }
    }
  }
}

TEST_F(DocumentedRightsTest, SequencesAndFunctionsAreUsedAsDocumented) {
  for (const auto& [role, user] : everybody()) {
    SCOPED_TRACE(role);
    const DocumentedRights rights(role);
    const LoginSession session = log_in(user);
    for (const auto& row :
         database->rows("SELECT relname FROM pg_class WHERE relkind = 'S' AND relnamespace ="
                        " 'loopscope'::regnamespace")) {
      const std::string literal = "'loopscope." + row[0] + "'";
      expect_state(session, "SELECT nextval(" + literal + ")", rights.on_sequence(row[0]));
      expect_state(session, "SELECT last_value FROM loopscope." + row[0], rights.reads_sequences());
      expect_state(session, "SELECT setval(" + literal + ", 1)", false);
      expect_state(session, "ALTER SEQUENCE loopscope." + row[0] + " RESTART", false);
    }
    for (const auto& row : database->rows(
             "SELECT oid::regprocedure, proname || '(' || (SELECT coalesce(string_agg('NULL::' ||"
             " format_type(t, NULL), ', '), '') FROM unnest(proargtypes) AS t) || ')',"
             " prorettype = 'trigger'::regtype, proname || '()' FROM pg_proc"
             " WHERE pronamespace = 'loopscope'::regnamespace")) {
      const bool trigger = row[2] == "t";
      if (!trigger) expect_state(session, "SELECT loopscope." + row[1], rights.on_function(row[3]));
      expect_state(session, "DROP FUNCTION " + row[0], false);
      expect_state(session, "ALTER FUNCTION " + row[0] + " SECURITY DEFINER", false);
    }
  }
}

TEST_F(DocumentedRightsTest, NothingCanBePassedOn) {
  EXPECT_EQ(database->value(
                "SELECT count(*) FROM (SELECT relacl AS acl FROM pg_class UNION ALL SELECT attacl"
                " FROM pg_attribute UNION ALL SELECT proacl FROM pg_proc UNION ALL SELECT nspacl"
                " FROM pg_namespace) AS a CROSS JOIN aclexplode(acl) AS granted WHERE is_grantable"
                " AND grantee::regrole::text LIKE 'loopscope%' AND grantee <> grantor"),
            "0");
}

TEST_F(DocumentedRightsTest, PublicHasNothingInTheSchema) {
  EXPECT_EQ(database->value(
                "SELECT count(*) FROM ("
                " SELECT relacl AS acl, relnamespace AS n FROM pg_class UNION ALL"
                " SELECT attacl, relnamespace FROM pg_attribute JOIN pg_class ON"
                "  pg_class.oid = attrelid UNION ALL"
                // NULL stands for the usual: EXECUTE for everybody.
                " SELECT coalesce(proacl, acldefault('f', proowner)), pronamespace FROM pg_proc"
                " UNION ALL SELECT nspacl, oid FROM pg_namespace) AS a"
                " CROSS JOIN aclexplode(acl) AS granted"
                " WHERE grantee = 0 AND n = 'loopscope'::regnamespace"),
            "0");
}

TEST_F(DocumentedRightsTest, FunctionsOfTheSchemaLookIntoPgCatalogAndRunWithTheCallersRights) {
  EXPECT_THAT(
      database->rows("SELECT oid::regprocedure FROM pg_proc WHERE pronamespace ="
                     " 'loopscope'::regnamespace AND (prosecdef OR prosqlbody IS NULL AND NOT"
                     " coalesce(proconfig, '{}')::text LIKE '%search_path=pg_catalog%')"),
      IsEmpty());
}

TEST_F(DocumentedRightsTest, MigrateTakesBackWhatIsNotDocumented) {
  database->execute(
      "GRANT ALL ON ALL TABLES IN SCHEMA loopscope TO loopscope_worker, loopscope_reader, PUBLIC;"
      "GRANT ALL ON ALL FUNCTIONS IN SCHEMA loopscope TO loopscope_historian, PUBLIC;"
      "GRANT ALL ON SCHEMA loopscope TO loopscope_historian, PUBLIC;"
      "GRANT UPDATE (slot_end) ON loopscope.verdict TO loopscope_reader;"
      "GRANT INSERT ON loopscope.annotation TO " +
      stranger);
  migrate(settings_for(*database, owner));
  EXPECT_EQ(log_in(worker).state_of("DELETE FROM loopscope.verdict"), kRefused);
  EXPECT_EQ(log_in(worker).state_of("UPDATE loopscope.analysis SET loop_id = 1"), kRefused);
  EXPECT_EQ(log_in(reader).state_of("INSERT INTO loopscope.annotation DEFAULT VALUES"), kRefused);
  EXPECT_EQ(log_in(reader).state_of("UPDATE loopscope.verdict SET slot_end = now()"), kRefused);
  EXPECT_EQ(log_in(historian).state_of("SELECT loopscope.partitioned_tables()"), kRefused);
  EXPECT_EQ(database->value("SELECT has_table_privilege('" + stranger +
                            "', 'loopscope.annotation', 'INSERT')"),
            "t")
      << "persons keep theirs";
}

TEST_F(DocumentedRightsTest, TheOwnerNeedsTheDatabaseOnlyForTheFirstMigrate) {
  database->execute("REVOKE CREATE ON DATABASE " + database->name() + " FROM loopscope_owner");
  EXPECT_TRUE(migrate(settings_for(*database, owner)).empty());
  EXPECT_NO_THROW(
      static_cast<void>(maintain(settings_for(*database, owner), {.retention_months = 12})));
  EXPECT_EQ(log_in(owner).state_of("CREATE SCHEMA planted"), kRefused);
}

TEST_F(DocumentedRightsTest, ASharedDatabaseKeepsWhatItsOtherUsersNeed) {
  tests::TestDatabase shared;
  shared.execute("CREATE TABLE public.of_somebody (x int)");
  shared.make_roles();
  const std::string somebody = shared.make_login("");
  EXPECT_EQ(LoginSession(shared.conninfo(somebody)).state_of("CREATE TEMP TABLE t (x int)"), "");
}

}  // namespace
}  // namespace loopscope::storage
