#include <gmock/gmock.h>

#include "storage/historian/pq_connection.hpp"
#include "tests/storage/results/role_fixture.hpp"

namespace loopscope::storage {
namespace {

using tests::LoginSession;

class RoleRefusalTest : public RoleTest {};

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
          "SELECT pg_logical_emit_message(false, 'x', 'x')",
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

TEST_F(RoleRefusalTest, NobodyLeavesHisTask) {
  const std::string launcher = database->value(
      "SELECT pid FROM pg_stat_activity WHERE backend_type = 'autovacuum launcher'");
  for (const std::string& user : {owner, worker, reader, engineer, historian, stranger}) {
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
  for (const std::string& user : {worker, reader, engineer, historian, stranger}) {
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
  const std::vector<std::pair<std::string, std::string>> group{
      {owner, "loopscope_owner"},         {worker, "loopscope_worker"},
      {reader, "loopscope_reader"},       {engineer, "loopscope_engineer"},
      {historian, "loopscope_historian"}, {stranger, ""}};
  const auto roles = database->rows(
      "SELECT rolname FROM pg_roles WHERE rolname IN ('postgres', 'loopscope_owner',"
      " 'loopscope_worker', 'loopscope_reader', 'loopscope_engineer', 'loopscope_historian',"
      " 'pg_read_server_files',"
      " 'pg_write_all_data', 'pg_execute_server_program', 'pg_monitor', 'pg_signal_backend')");
  EXPECT_EQ(roles.size(), 11U);
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
  ConnectionSettings settings = settings_for(*database, "postgres");
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

}  // namespace
}  // namespace loopscope::storage
