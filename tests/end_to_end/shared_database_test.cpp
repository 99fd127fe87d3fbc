#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <optional>
#include <regex>
#include <thread>

#include "tests/end_to_end/plant.hpp"
#include "tests/end_to_end/ready_queries.hpp"
#include "tests/support/environment.hpp"
#include "tests/support/sql_connection.hpp"

namespace loopscope::tests {
namespace {

/// A database that others share, in which one of them may make objects in `public` and has planted
/// functions, operators, casts, views and tables there under the names that the program's
/// statements and scripts use (tests/support/traps.sql). Whatever we run, nothing of his is
/// executed.
class SharedDatabase : public testing::Test {
 protected:
  void SetUp() override {
    if (!test_server()) GTEST_SKIP() << kNoServer;
    database.emplace();
    database->execute("CREATE TABLE public.of_somebody (x int)");
    const std::string somebody = database->make_login("");
    database->execute("GRANT CREATE ON SCHEMA public TO " + somebody);
    outsider.emplace(database->conninfo(somebody));  // stays, and with it what is temporary
    outsider->run(content_of(source_dir() / "tests" / "support" / "traps.sql"));
  }

  /// As deploy/SECURITY.md tells to make them.
  void make_logins() {
    for (const char* group : {"owner", "worker", "reader", "engineer", "historian"}) {
      logins[group] = database->make_login("loopscope_" + std::string(group));
      database->execute("ALTER ROLE " + logins[group] + " SET search_path = pg_catalog, pg_temp");
    }
    // The site's own: its tables are named with their schema.
    logins["site"] = database->make_login("");
    database->execute(
        "CREATE SCHEMA site AUTHORIZATION " + logins["site"] +
        "; GRANT USAGE ON SCHEMA site TO loopscope_historian; ALTER DEFAULT PRIVILEGES FOR ROLE " +
        logins["site"] + " IN SCHEMA site GRANT SELECT ON TABLES TO loopscope_historian");
  }

  void write_settings() const {
    std::ofstream(settings_file())
        << R"({"results": {"connection": ")" << as("worker") << R"(", "owner_connection": ")"
        << as("owner") << R"(", "engineer_connection": ")" << as("engineer")
        << R"("}, "historians": [{"name": "plant", "connection": ")" << as("historian")
        << R"(", "writer_connection": ")" << as("site")
        << R"(", "table": "site.history"}], "schedule": {"settle_s": 0}})";
  }

  [[nodiscard]] std::string as(const std::string& role) const {
    return database->conninfo(logins.at(role));
  }
  [[nodiscard]] std::string settings_file() const { return folder.path() / "loopscope.json"; }

  /// Runs a command to its end; none steps into a trap.
  std::string loopscope(const std::string& command, std::vector<std::string> words = {}) const {
    words.insert(words.begin(), {LOOPSCOPE_PROGRAM, command, "--config", settings_file()});
    return run(command, words);
  }
  std::string run(const std::string& what, const std::vector<std::string>& words) const {
    const ProgramResult done = run_program(words);
    EXPECT_EQ(done.exit_code, 0) << what << ": " << done.err;
    EXPECT_FALSE(sprung()) << what << ": " << done.err;
    return done.out;
  }
  void psql(const std::string& conninfo, const std::vector<std::string>& words) const {
    std::vector<std::string> command{kPsql, "-Xq", "-v", "ON_ERROR_STOP=1", "-d", conninfo};
    command.insert(command.end(), words.begin(), words.end());
    run(words.back(), command);
  }

  /// Whether something of the outsider's was executed: a sequence forgets nothing.
  [[nodiscard]] bool sprung() const {
    return database->value("SELECT is_called FROM public.sprung") == "t";
  }

  /// A mail program that takes everything.
  [[nodiscard]] std::string reads_all() const {
    const std::filesystem::path program = folder.path() / "mail";
    std::ofstream(program) << "#!/bin/sh\ncat >/dev/null\n";
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    return program;
  }

  void import_loop() const {
    const std::string file = folder.path() / "r.csv";
    run("simulate",
        {LOOPSCOPE_PROGRAM, "simulate", "sticking_valve", "--seed", "5", "--no-mv", "--out", file});
    loopscope("import", {"--create-table", "--loop", "FIC1", file});
  }

  TemporaryFolder folder;
  std::optional<TestDatabase> database;
  std::optional<SqlConnection> outsider;
  std::map<std::string, std::string> logins;
};

TEST_F(SharedDatabase, TheTrapsAreTraps) {
  const SqlConnection careless(database->conninfo());
  EXPECT_THROW(careless.run("SELECT format('%I', 'x'::name)"), std::runtime_error);
  EXPECT_TRUE(sprung());
}

TEST_F(SharedDatabase, ScriptsAndCommandsExecuteNothingOfAnOutsiders) {
  psql(database->conninfo(), {"-f", source_dir() / "deploy" / "roles.sql"});
  make_logins();
  write_settings();
  loopscope("migrate");
  import_loop();
  for (const char* command : {"check-config", "once", "maintain"}) loopscope(command);
  run("init",
      {LOOPSCOPE_PROGRAM, "init", "--results", as("worker"), "--owner", as("owner"), "--historian",
       as("historian"), "--table", "site.history", "--out", folder.path() / "init.json"});
  loopscope("loops", {"list"});
  loopscope("loops", {"check"});
  loopscope("loops", {"discover"});
  loopscope("report", {"--out", folder.path()});
  loopscope("export", {"flagged_loop"});
  loopscope("window", {"--loop", "FIC1", "--out", folder.path() / "w.csv"});
  loopscope("replay", {database->value("SELECT max(analysis_id) FROM loopscope.analysis")});
  loopscope("annotate", {"--loop", "FIC1", "acknowledge"});
  loopscope("annotate", {"--loop", "FIC1", "withdraw"});
  loopscope("maintenance",
            {"add", "--loop", "FIC1", "--at", "2026-01-01", "--kind", "valve", "new packing"});
  loopscope("maintenance", {"list"});
}

/// By logins that are made as the README tells, in sessions of psql.
TEST_F(SharedDatabase, WhatPeopleAskExecutesNothingOfAnOutsiders) {
  psql(database->conninfo(), {"-f", source_dir() / "deploy" / "roles.sql"});
  make_logins();
  write_settings();
  loopscope("migrate");
  psql(database->conninfo(), {"-f", source_dir() / "tests" / "support" / "told_plant.sql"});
  for (const ReadyQuery& query : ready_queries())
    psql(as(query.writes() ? "engineer" : "reader"), {"-c", query.statement});
  // Between backquotes, as tests/deploy/runbook_sql_test finds them.
  const std::string runbook = content_of(source_dir() / "deploy" / "RUNBOOK.md");
  const std::regex statement("`(SELECT [^`]*)`");
  int count = 0;
  for (std::sregex_iterator at(runbook.begin(), runbook.end(), statement), end; at != end; ++at) {
    const std::string text = std::regex_replace((*at)[1].str(), std::regex(R"(\(N\))"), "(0)");
    psql(as("owner"), {"-c", text});
    ++count;
  }
  EXPECT_GT(count, 10);
}

/// It makes its sessions safe by itself, whatever login it is given.
TEST_F(SharedDatabase, TheHookExecutesNothingOfAnOutsiders) {
  psql(database->conninfo(), {"-f", source_dir() / "deploy" / "roles.sql"});
  make_logins();
  write_settings();
  loopscope("migrate");
  psql(database->conninfo(), {"-f", source_dir() / "tests" / "support" / "told_plant.sql"});
  const std::string login = database->make_login("loopscope_reader");
  const std::string host =
      std::regex_replace(*test_server(), std::regex("^.*host=([^ ]*).*$"), "$1");
  const EnvironmentVariable where("PGHOST", host), user("PGUSER", login),
      name("PGDATABASE", database->name()), to("LOOPSCOPE_HOOK_MAIL_TO", "us@example.org"),
      mailer("SENDMAIL", reads_all()), state("LOOPSCOPE_HOOK_STATE", folder.path());
  const std::filesystem::path sent = folder.path() / "sent-flagged", log = folder.path() / "log";
  std::ofstream(sent).close();  // nobody was told of anything yet
  const BackgroundProgram hook({source_dir() / "deploy" / "hooks" / "loopscope-hook"}, log);
  for (int tries = 0; tries < 300 && content_of(sent).empty(); ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_NE(content_of(sent), "") << content_of(log);
  EXPECT_FALSE(sprung()) << content_of(log);
  hook.send(SIGTERM);
}

}  // namespace
}  // namespace loopscope::tests
