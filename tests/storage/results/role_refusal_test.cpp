#include <gmock/gmock.h>

#include "storage/historian/pq_connection.hpp"
#include "storage/results/migrate.hpp"
#include "tests/storage/results/documented_rights.hpp"
#include "tests/storage/results/results_fixture.hpp"
#include "tests/support/login_session.hpp"

namespace loopscope::storage {
namespace {

using testing::AnyOf;
using testing::IsEmpty;
using tests::LoginSession;

constexpr const char* kRefused = "42501";
constexpr const char* kNotUpdatable = "55000";  // what a view says before rights are looked at

/// Every role tries everything: what storage/README.md does not list has to be refused, and what it
/// lists has to be allowed. The objects come from the catalogue, so that a new one is tried too.
class RoleRefusalTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!tests::test_server()) GTEST_SKIP() << tests::kNoServer;
    database = std::make_unique<tests::TestDatabase>();
    database->make_roles();
    owner = database->make_login("loopscope_owner");
    worker = database->make_login("loopscope_worker");
    reader = database->make_login("loopscope_reader");
    historian = database->make_login("loopscope_historian");
    stranger = database->make_login("");
    migrate(settings_for(*database, owner));
    Catalogue(settings_for(*database, owner)).save(std::vector{loop_named("a")});
    database->execute(
        "CREATE SCHEMA site; CREATE TABLE site.history (tag text, time timestamptz, value real,"
        " quality int); CREATE TABLE site.payroll (name text, pay int);"
        "CREATE TABLE public.other (x int); CREATE SEQUENCE site.numbers;"
        "CREATE FUNCTION site.secret() RETURNS int LANGUAGE sql AS 'SELECT 1';"
        "REVOKE ALL ON FUNCTION site.secret() FROM PUBLIC;"
        "GRANT USAGE ON SCHEMA site TO loopscope_historian;"
        "GRANT SELECT ON site.history TO loopscope_historian");
  }

  [[nodiscard]] LoginSession log_in(const std::string& user) const {
    return LoginSession(database->conninfo(user));
  }

  void expect_state(const LoginSession& session, const std::string& command, bool allowed) const {
    const std::string state = session.state_of(command);
    if (allowed) {
      EXPECT_NE(state, kRefused) << command;
    } else {
      EXPECT_THAT(state, AnyOf(kRefused, kNotUpdatable)) << command;
    }
  }

  /// Tables, views and partitions of a schema: name, whether a view, whether a partition.
  [[nodiscard]] std::vector<std::vector<std::string>> relations(const std::string& schema) const {
    return database->rows(
        "SELECT relname, relkind = 'v', relispartition FROM pg_class WHERE relkind IN"
        " ('r', 'p', 'v', 'm', 'f') AND relnamespace = '" +
        schema + "'::regnamespace ORDER BY relname");
  }

  [[nodiscard]] std::vector<std::string> columns(const std::string& relation) const {
    std::vector<std::string> names;
    for (const auto& row :
         database->rows("SELECT attname FROM pg_attribute WHERE attrelid = '" + relation +
                        "'::regclass AND attnum > 0 AND NOT attisdropped"))
      names.push_back(row[0]);
    return names;
  }

  std::unique_ptr<tests::TestDatabase> database;
  std::string owner, worker, reader, historian, stranger;
};

/// Commands that change what a table is; nobody but its owner may.
std::vector<std::string> ddl_on(const std::string& relation, bool view) {
  const std::string kind = view ? "VIEW " : "TABLE ";
  std::vector<std::string> commands{
      "DROP " + kind + relation, "ALTER " + kind + relation + " RENAME TO stolen",
      "ALTER " + kind + relation + " OWNER TO CURRENT_USER",
      "COMMENT ON " + kind + relation + " IS 'x'",
      "CREATE RULE r AS ON INSERT TO " + relation + " DO INSTEAD NOTHING"};
  if (view) return commands;
  for (const char* command :
       {"TRUNCATE %", "ALTER TABLE % ADD COLUMN planted int", "ALTER TABLE % DISABLE TRIGGER ALL",
        "ALTER TABLE % ENABLE ROW LEVEL SECURITY", "CREATE POLICY p ON % USING (true)",
        "CREATE INDEX ON % ((1))", "REINDEX TABLE %", "LOCK TABLE % IN ACCESS EXCLUSIVE MODE",
        "CREATE TRIGGER t BEFORE INSERT ON % EXECUTE FUNCTION"
        " suppress_redundant_updates_trigger()"}) {
    std::string text = command;
    commands.push_back(text.replace(text.find('%'), 1, relation));
  }
  return commands;
}

/// What is outside of every role's task, whatever the schema.
std::vector<std::string> never_allowed() {
  return {"CREATE ROLE planted",
          "ALTER ROLE CURRENT_USER SUPERUSER",
          "ALTER ROLE CURRENT_USER CREATEROLE",
          "ALTER ROLE postgres PASSWORD 'x'",
          "GRANT postgres TO CURRENT_USER",
          "SET SESSION AUTHORIZATION postgres",
          "SET ROLE postgres",
          "SET session_replication_role = replica",
          "SET log_statement = 'none'",
          "LOAD '/tmp/planted.so'",
          "COPY (SELECT 1) TO PROGRAM 'true'",
          "COPY (SELECT 1) TO '/tmp/planted'",
          "CREATE EXTENSION dblink",
          "CREATE EXTENSION file_fdw",
          "CREATE EXTENSION adminpack",
          "CREATE EVENT TRIGGER planted ON"
          " ddl_command_start EXECUTE FUNCTION suppress_redundant_updates_trigger()",
          "CREATE FUNCTION site.planted() RETURNS int LANGUAGE c AS '/tmp/planted.so'",
          "CREATE FOREIGN DATA WRAPPER planted",
          "SELECT pg_read_file('/etc/passwd')",
          "SELECT pg_read_binary_file('/etc/passwd')",
          "SELECT pg_ls_dir('.')",
          "SELECT pg_stat_file('PG_VERSION')",
          "SELECT lo_import('/etc/passwd')",
          "SELECT lo_export(1, '/tmp/planted')",
          "SELECT lo_create(0)",
          "SELECT lo_creat(-1)",
          "SELECT lo_from_bytea(0, 'x')",
          "SELECT pg_reload_conf()",
          "SELECT pg_rotate_logfile()",
          "SELECT pg_switch_wal()",
          "SELECT pg_create_restore_point('x')",
          "SELECT pg_promote()",
          "SELECT pg_stat_reset()",
          "SELECT pg_replication_origin_create('x')",
          "SELECT pg_create_physical_replication_slot('x')",
          "SELECT * FROM pg_authid",
          "SELECT * FROM pg_shadow",
          "SELECT * FROM pg_hba_file_rules",
          "SELECT * FROM pg_file_settings",
          "SELECT * FROM pg_statistic",
          "TABLE pg_user_mapping",
          "UPDATE pg_class SET relowner = 10",
          "DELETE FROM pg_depend",
          "INSERT INTO pg_auth_members"
          " VALUES (1, 1, 1, true)",
          "CREATE TABLE site.planted (x int)",
          "CREATE TABLE public.planted (x int)",
          "CREATE TYPE public.planted AS (x int)",
          "CREATE FUNCTION public.now() RETURNS int LANGUAGE sql AS 'SELECT 1'",
          "CREATE TEMP TABLE planted (x int)",
          "CREATE TABLE pg_catalog.planted (x int)",
          "SELECT site.secret()",
          "SELECT nextval('site.numbers')",
          "TABLE site.payroll",
          "TABLE public.other",
          "INSERT INTO site.history VALUES ('a')",
          "DELETE FROM site.history",
          "DROP SCHEMA site CASCADE",
          "DROP SCHEMA public CASCADE",
          "CREATE PUBLICATION planted FOR"
          " ALL TABLES",
          "REASSIGN OWNED BY postgres TO CURRENT_USER",
          "DROP OWNED BY postgres",
          "ALTER DEFAULT PRIVILEGES FOR ROLE postgres GRANT SELECT ON TABLES TO PUBLIC"};
}

/// These refuse to run in a transaction, whoever asks.
std::vector<std::string> never_allowed_bare() {
  return {"ALTER SYSTEM SET log_statement = 'none'", "CREATE DATABASE planted",
          "CREATE TABLESPACE planted LOCATION '/tmp'",
          "CREATE SUBSCRIPTION planted CONNECTION 'dbname=x' PUBLICATION y", "CHECKPOINT"};
}

TEST_F(RoleRefusalTest, EveryTableOfTheSchemaIsReadAndWrittenAsDocumentedAndNoOtherWay) {
  for (const auto& [role, user] : {std::pair{"worker", worker},
                                   {"reader", reader},
                                   {"historian", historian},
                                   {"stranger", stranger}}) {
    SCOPED_TRACE(role);
    const DocumentedRights rights(role);
    const LoginSession session = log_in(user);
    for (const auto& relation : relations("loopscope")) {
      const std::string name = "loopscope." + relation[0];
      const bool view = relation[1] == "t", partition = relation[2] == "t";
      // Partitions are reached through their tables; those that are older than the last migrate
      // can be read by themselves.
      if (!partition)
        expect_state(session, "TABLE " + name, rights.on_table("SELECT", relation[0]));
      expect_state(session, "INSERT INTO " + name + " DEFAULT VALUES",
                   rights.on_table("INSERT", relation[0]));
      expect_state(session, "DELETE FROM " + name, false);
      for (const std::string& command : ddl_on(name, view)) expect_state(session, command, false);
    }
  }
}

TEST_F(RoleRefusalTest, EveryColumnIsUpdatedAsDocumentedAndNoOther) {
  for (const auto& [role, user] : {std::pair{"worker", worker}, {"reader", reader}}) {
    const DocumentedRights rights(role);
    const LoginSession session = log_in(user);
    for (const auto& relation : relations("loopscope")) {
      for (const std::string& column : columns("loopscope." + relation[0]))
        expect_state(session,
                     "UPDATE loopscope." + relation[0] + " SET " + column +
                         " = DEFAULT"
                         " WHERE false",
                     rights.update_of(relation[0], column));
    }
  }
}

TEST_F(RoleRefusalTest, SequencesAndFunctionsAreUsedAsDocumented) {
  for (const auto& [role, user] : {std::pair{"worker", worker},
                                   {"reader", reader},
                                   {"historian", historian},
                                   {"stranger", stranger}}) {
    SCOPED_TRACE(role);
    const DocumentedRights rights(role);
    const LoginSession session = log_in(user);
    for (const auto& row :
         database->rows("SELECT relname FROM pg_class WHERE relkind = 'S' AND relnamespace ="
                        " 'loopscope'::regnamespace")) {
      const std::string literal = "'loopscope." + row[0] + "'";
      expect_state(session, "SELECT nextval(" + literal + ")", rights.on_sequence(row[0]));
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

TEST_F(RoleRefusalTest, NobodyLeavesHisTask) {
  const std::string launcher = database->value(
      "SELECT pid FROM pg_stat_activity WHERE backend_type = 'autovacuum launcher'");
  for (const std::string& user : {owner, worker, reader, historian, stranger}) {
    SCOPED_TRACE(user);
    const LoginSession session = log_in(user);
    for (const std::string& command : never_allowed()) {
      EXPECT_EQ(session.state_of(command), kRefused) << command;
    }
    for (const std::string& command : never_allowed_bare())
      EXPECT_EQ(session.state_of_bare(command), kRefused) << command;
    EXPECT_EQ(session.state_of_bare("DROP DATABASE postgres"), kRefused);
    EXPECT_EQ(session.state_of("SELECT pg_terminate_backend(" + launcher + ")"), kRefused);
    EXPECT_EQ(session.state_of("ALTER DATABASE " + database->name() + " SET jit = on"), kRefused);
  }
}

TEST_F(RoleRefusalTest, NobodyButTheOwnerMakesAnything) {
  for (const std::string& user : {worker, reader, historian, stranger}) {
    const LoginSession session = log_in(user);
    for (const char* what : {"TABLE loopscope.p (x int)", "VIEW loopscope.p AS SELECT 1",
                             "SEQUENCE loopscope.p", "TYPE loopscope.p AS (x int)",
                             "FUNCTION loopscope.p() RETURNS int LANGUAGE sql AS 'SELECT 1'",
                             "SCHEMA planted", "SCHEMA AUTHORIZATION CURRENT_USER"})
      EXPECT_EQ(session.state_of(std::string("CREATE ") + what), kRefused) << user << ": " << what;
    EXPECT_EQ(session.state_of("DROP SCHEMA loopscope CASCADE"), kRefused);
    EXPECT_EQ(session.state_of("ALTER SCHEMA loopscope RENAME TO x"), kRefused);
    EXPECT_EQ(session.state_of("REASSIGN OWNED BY loopscope_owner TO CURRENT_USER"), kRefused);
    EXPECT_EQ(session.state_of("DROP OWNED BY loopscope_owner"), kRefused);
  }
}

TEST_F(RoleRefusalTest, NobodyBecomesSomebodyElse) {
  const std::vector<std::pair<std::string, std::string>> group{{owner, "loopscope_owner"},
                                                               {worker, "loopscope_worker"},
                                                               {reader, "loopscope_reader"},
                                                               {historian, "loopscope_historian"},
                                                               {stranger, ""}};
  const auto roles = database->rows(
      "SELECT rolname FROM pg_roles WHERE rolname IN ('postgres', 'loopscope_owner',"
      " 'loopscope_worker', 'loopscope_reader', 'loopscope_historian', 'pg_read_server_files',"
      " 'pg_write_all_data', 'pg_execute_server_program', 'pg_monitor', 'pg_signal_backend')");
  EXPECT_EQ(roles.size(), 10U);
  for (const auto& [user, own] : group) {
    const LoginSession session = log_in(user);
    for (const auto& role : roles) {
      EXPECT_EQ(session.state_of("SET ROLE " + role[0]), role[0] == own ? "" : kRefused)
          << user << " becomes " << role[0];
      EXPECT_EQ(session.state_of("GRANT " + role[0] + " TO " + stranger), kRefused)
          << user << " gives " << role[0] << " away";
    }
  }
}

TEST_F(RoleRefusalTest, NothingCanBePassedOn) {
  EXPECT_EQ(database->value(
                "SELECT count(*) FROM (SELECT relacl AS acl FROM pg_class UNION ALL SELECT attacl"
                " FROM pg_attribute UNION ALL SELECT proacl FROM pg_proc UNION ALL SELECT nspacl"
                " FROM pg_namespace) AS a CROSS JOIN aclexplode(acl) AS granted WHERE is_grantable"
                " AND grantee::regrole::text LIKE 'loopscope%' AND grantee <> grantor"),
            "0");
}

TEST_F(RoleRefusalTest, PublicHasNothingInTheSchema) {
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

TEST_F(RoleRefusalTest, FunctionsOfTheSchemaLookIntoPgCatalogAndRunWithTheCallersRights) {
  EXPECT_THAT(
      database->rows("SELECT oid::regprocedure FROM pg_proc WHERE pronamespace ="
                     " 'loopscope'::regnamespace AND (prosecdef OR prosqlbody IS NULL AND NOT"
                     " coalesce(proconfig, '{}')::text LIKE '%search_path=pg_catalog%')"),
      IsEmpty());
}

TEST_F(RoleRefusalTest, HistorianReaderReadsWhatIsGrantedAndNothingElse) {
  const LoginSession session = log_in(historian);
  EXPECT_EQ(session.state_of("TABLE site.history"), "");
  for (const auto& relation : relations("site")) {
    const std::string name = "site." + relation[0];
    if (relation[0] != "history") expect_state(session, "TABLE " + name, false);
    expect_state(session, "INSERT INTO " + name + " DEFAULT VALUES", false);
    expect_state(session, "DELETE FROM " + name, false);
    for (const std::string& column : columns(name))
      expect_state(session, "UPDATE " + name + " SET " + column + " = DEFAULT", false);
    for (const std::string& command : ddl_on(name, false)) expect_state(session, command, false);
  }
}

TEST_F(RoleRefusalTest, SessionsOnAHistorianWriteNothingWhateverTheLoginMay) {
  ConnectionSettings settings = settings_for(*database);
  settings.purpose = "historian";
  settings.read_only = true;
  PqConnection session(settings);
  for (const char* command :
       {"INSERT INTO site.history VALUES ('a')", "DELETE FROM site.payroll",
        "CREATE TABLE site.planted (x int)", "DROP TABLE site.payroll",
        "SELECT nextval('site.numbers')", "GRANT SELECT ON site.payroll TO PUBLIC"}) {
    try {
      session.run({"attempt", command});
      ADD_FAILURE() << "carried out: " << command;
    } catch (const DatabaseError& error) {
      EXPECT_EQ(error.sqlstate(), "25006") << command;
    }
  }
}

TEST_F(RoleRefusalTest, MigrateTakesBackWhatIsNotDocumented) {
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

TEST_F(RoleRefusalTest, TheOwnerNeedsTheDatabaseOnlyForTheFirstMigrate) {
  database->execute("REVOKE CREATE ON DATABASE " + database->name() + " FROM loopscope_owner");
  EXPECT_TRUE(migrate(settings_for(*database, owner)).empty());
  EXPECT_NO_THROW(static_cast<void>(maintain(settings_for(*database, owner), 12)));
  EXPECT_EQ(log_in(owner).state_of("CREATE SCHEMA planted"), kRefused);
}

TEST_F(RoleRefusalTest, ASharedDatabaseKeepsWhatItsOtherUsersNeed) {
  tests::TestDatabase shared;
  shared.execute("CREATE TABLE public.of_somebody (x int)");
  shared.make_roles();
  const std::string somebody = shared.make_login("");
  EXPECT_EQ(LoginSession(shared.conninfo(somebody)).state_of("CREATE TEMP TABLE t (x int)"), "");
}

}  // namespace
}  // namespace loopscope::storage
