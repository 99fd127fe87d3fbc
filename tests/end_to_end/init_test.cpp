#include <algorithm>
#include <fstream>
#include <future>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>
#include <sstream>

#include "tests/end_to_end/plant.hpp"
#include "tests/support/environment.hpp"
#include "tests/support/tls_server.hpp"

namespace loopscope::tests {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kPassword = "Zq9-geheim-77";

/// A historian as Telegraf writes it (no index, times without a zone, a row a metric, fields of one
/// loop), and a plain table whose columns are called otherwise.
constexpr const char* kHistorian = R"(
CREATE TEMPORARY TABLE recording (t_s float8, sp float8, pv float8, op float8, mv float8);
\copy recording FROM '@CSV@' CSV HEADER
CREATE TEMPORARY TABLE moment AS SELECT r.*, now() - interval '2 minutes'
  - (max(t_s) OVER () - t_s) * interval '1 second' AS at FROM recording AS r;
CREATE SCHEMA telegraf;
CREATE TABLE telegraf.opcua (time timestamp without time zone, host text, loop text,
  "SP" double precision, "PV" double precision, "OP" double precision, "MODE" text);
INSERT INTO telegraf.opcua SELECT at AT TIME ZONE 'UTC', 'plc1', 'FIC101', NULL, pv, op, 'AUTO' FROM moment;
INSERT INTO telegraf.opcua SELECT at AT TIME ZONE 'UTC', 'plc1', 'FIC101', sp, NULL, NULL, NULL FROM moment;
CREATE TABLE public.archive (tagname text, ts timestamptz, val real, status smallint);
INSERT INTO public.archive SELECT 'FIC201.' || tag, at, value, 192
  FROM moment, LATERAL (VALUES ('SP', sp), ('PV', pv), ('OP', op)) AS of_loop (tag, value);
CREATE INDEX ON public.archive (tagname, ts) INCLUDE (val, status);
)";

const std::string kIndex = R"(CREATE INDEX CONCURRENTLY ON "telegraf"."opcua" ("loop", "time");)";

/// Two fresh servers whose logins need passwords, none of which is there yet.
class Init : public testing::Test {
 protected:
  void SetUp() override {
    auto results = std::async(std::launch::async, [] { return std::make_unique<TlsServer>(); });
    historian_server = std::make_unique<TlsServer>();
    results_server = results.get();
    historian_server->execute("CREATE DATABASE plant");
    write("pgpass", "", 0600);
    password_file.emplace("PGPASSFILE", file("pgpass"));
    const std::string csv = file("recording.csv");
    ASSERT_EQ(
        run_program({LOOPSCOPE_PROGRAM, "simulate", "sticking_valve", "--seed", "1", "--out", csv})
            .exit_code,
        0);
    std::string sql = kHistorian;
    sql.replace(sql.find("@CSV@"), 5, csv);
    psql(*historian_server, "plant", "fill.sql", sql);
  }

  [[nodiscard]] std::string file(const std::string& name) const { return folder.path() / name; }

  void write(const std::string& name, const std::string& text, unsigned mode) const {
    std::ofstream(folder.path() / name) << text;
    std::filesystem::permissions(folder.path() / name, std::filesystem::perms(mode));
  }

  /// Runs a script as the superuser; psql, which has no terminal here, reads passwords from its
  /// input.
  void psql(const TlsServer& server, const std::string& database, const std::string& name,
            const std::string& sql) const {
    write(name, sql, 0644);
    const ProgramResult done = run_program(
        {"/bin/sh", "-c",
         "yes '" + std::string(kPassword) + "' | setsid -w psql -Xq -v ON_ERROR_STOP=1 -d '" +
             server.superuser() + " dbname=" + database + "' -f " + file(name)});
    ASSERT_EQ(done.exit_code, 0) << done.err;
  }

  [[nodiscard]] std::string address(const TlsServer& server, const std::string& database) const {
    return "host=localhost port=" + std::to_string(server.port()) + " dbname=" + database;
  }

  [[nodiscard]] ProgramResult init(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{LOOPSCOPE_PROGRAM, "init",
                                       "--results",       address(*results_server, "loopscope"),
                                       "--historian",     address(*historian_server, "plant")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(arguments);
  }

  // NOLINTNEXTLINE(modernize-use-nodiscard): of some commands the exit code is all
  std::string loopscope(const std::string& settings, std::vector<std::string> words,
                        int exit_code = 0) const {
    words.insert(words.begin(), LOOPSCOPE_PROGRAM);
    words.insert(words.begin() + 2, {"--config", file(settings)});
    const ProgramResult done = run_program(words);
    EXPECT_EQ(done.exit_code, exit_code) << words[1] << ": " << done.out << done.err;
    return done.out + done.err;
  }

  /// Writes the lines that init has asked for into the password file.
  void keep_passwords(const std::string& said) const {
    std::string passwords;
    std::istringstream lines(said);
    for (std::string line; std::getline(lines, line);) {
      if (!line.ends_with(":PASSWORD")) continue;
      line.replace(line.rfind("PASSWORD"), 8, kPassword);
      passwords += line + "\n";
    }
    EXPECT_EQ(std::ranges::count(passwords, '\n'), 5) << said;
    write("pgpass", passwords, 0600);
  }

  [[nodiscard]] std::string verdict_of(const std::string& loop) const {
    return run_program(
               {kPsql, "-XAt", "-d", results_server->superuser() + " dbname=loopscope", "-c",
                "SELECT code FROM loopscope.latest_verdict WHERE loop_name = '" + loop + "'"})
        .out;
  }

  /// Migrates, looks, registers, judges.
  void go_on_with(const std::string& settings) const {
    EXPECT_THAT(loopscope(settings, {"migrate"}), HasSubstr("is at version"));
    EXPECT_THAT(loopscope(settings, {"check-config"}), Not(HasSubstr("PROBLEM")));
    EXPECT_THAT(loopscope(settings, {"maintain"}),
                HasSubstr(" are there already; nothing to drop"));
    EXPECT_THAT(
        loopscope(settings, {"loops", "discover", "--add"}),
        AllOf(HasSubstr("1 loop added"), HasSubstr("loopscope loops --config " + file(settings))));
    EXPECT_THAT(loopscope(settings, {"once"}), HasSubstr("0 failed"));
  }

  /// Run 1 on bare servers, its SQL and its password lines carried out as they stand.
  void set_up_roles() const {
    const ProgramResult first = init({"--table", "telegraf.opcua", "--out", file("a.json")});
    EXPECT_EQ(first.exit_code, 4) << first.out << first.err;
    EXPECT_THAT(first.err, HasSubstr("run this `loopscope init` again"));
    EXPECT_FALSE(std::filesystem::exists(file("a.json")));
    const std::size_t results = first.out.find("-- Loopscope, for the results server");
    const std::size_t historian = first.out.find("-- Loopscope, for the historian");
    const std::size_t passwords = first.out.find("\nTheir passwords");
    ASSERT_TRUE(results < historian && historian < passwords) << first.out;
    psql(*results_server, "postgres", "results.sql",
         first.out.substr(results, historian - results));
    psql(*historian_server, "plant", "historian.sql",
         first.out.substr(historian, passwords - historian));
    keep_passwords(first.out);
  }

  /// `text` of the settings replaced.
  void change(const std::string& settings, const std::string& text, const std::string& by) const {
    std::string changed = content_of(file(settings));
    const std::size_t at = changed.find(text);
    ASSERT_NE(at, std::string::npos) << changed;
    write("changed.json", changed.replace(at, text.size(), by), 0600);
  }

  /// check-config finds what is wrong with the owner's connection before `migrate` does.
  void expect_every_connection_to_be_tried() const {
    const std::string owner = "user=loopscope_owner_1";
    change("a.json", owner, "service=nowhere");
    EXPECT_THAT(loopscope("changed.json", {"check-config"}, 4),
                HasSubstr("PROBLEM  results database, owner: definition of service \"nowhere\""));
    change("a.json", owner, "user=loopscope_worker_1");
    EXPECT_THAT(loopscope("changed.json", {"check-config"}, 4),
                HasSubstr("loopscope_worker_1 may not change the schema loopscope"));
    // A host of workers alone has no password for it.
    change("a.json", owner, "user=loopscope_owner_1 passfile=/nowhere");
    EXPECT_THAT(loopscope("changed.json", {"check-config"}),
                HasSubstr("warning  results database, owner: no password for this login"));
  }

  /// `line` of the password file by another one while init runs.
  [[nodiscard]] std::string init_with(const std::string& part, const std::string& by,
                                      const std::string& historian) const {
    const std::string passwords = content_of(file("pgpass"));
    std::string changed = passwords;
    if (const std::size_t at = changed.find(part); at != std::string::npos)
      changed.replace(at, part.size(), by);
    write("pgpass", changed, 0600);
    const ProgramResult done =
        run_program({LOOPSCOPE_PROGRAM, "init", "--results", address(*results_server, "loopscope"),
                     "--historian", address(*historian_server, historian), "--table",
                     "telegraf.opcua", "--out", file("a.json")});
    write("pgpass", passwords, 0600);
    EXPECT_EQ(done.exit_code, 4) << done.out << done.err;
    return done.out + done.err;
  }

  /// Once the logins are there, whoever mistypes something is not asked to make them again.
  void expect_mistakes_to_be_named() const {
    const auto makes_no_role = Not(HasSubstr("CREATE ROLE"));
    const std::string worker = ":loopscope_worker_1:";
    EXPECT_THAT(init_with(worker, worker + "not-", "plant"),
                AllOf(HasSubstr("the password is wrong, the login is there"), makes_no_role));
    EXPECT_THAT(init_with("", "", "plnt"),
                AllOf(HasSubstr("has one for dbname=plant"), makes_no_role));
    EXPECT_THAT(init_with(":plant:", ":*:", "plnt"),
                AllOf(HasSubstr("database \"plnt\" does not exist"), makes_no_role));
    EXPECT_THAT(init_with(":loopscope_historian_1:", ":loopscope_historian_1:not-", "plant"),
                HasSubstr("the server does not tell which"));
  }

  std::unique_ptr<TlsServer> results_server, historian_server;
  TemporaryFolder folder;
  std::optional<EnvironmentVariable> password_file;
};

TEST_F(Init, LeadsFromTwoBareServersToVerdicts) {
  set_up_roles();
  expect_mistakes_to_be_named();
  const ProgramResult second = init({"--table", "telegraf.opcua", "--out", file("a.json")});
  EXPECT_EQ(second.exit_code, 0) << second.out << second.err;
  EXPECT_THAT(second.out,
              AllOf(HasSubstr("telegraf.opcua: preset telegraf"), Not(HasSubstr("PROBLEM")),
                    HasSubstr("<<'SQL'\n" + kIndex + "\nSQL\nReview "),
                    HasSubstr("not migrated yet: there is no schema loopscope"),
                    HasSubstr("loopscope migrate --config " + file("a.json")),
                    HasSubstr("loopscope backfill --config " + file("a.json"))));
  EXPECT_THAT(content_of(file("a.json")),
              HasSubstr(" port=" + std::to_string(results_server->port()) +
                        " dbname=loopscope user=loopscope_engineer_1\""));
  EXPECT_THAT(loopscope("a.json", {"check-config"}, 4),
              AllOf(HasSubstr("PROBLEM  results database: not migrated yet: there is no schema"),
                    HasSubstr("`loopscope migrate --config " + file("a.json") + "` makes it"),
                    HasSubstr("1 problem with")));
  psql(*historian_server, "plant", "index.sql", kIndex);
  const ProgramResult nowhere =
      init({"--table", "telegraf.opcua", "--out", file("c.json"), "--time-zone", "Europe/Bonn"});
  EXPECT_EQ(nowhere.exit_code, 2) << nowhere.out;
  EXPECT_THAT(nowhere.err, HasSubstr("--time-zone: \"Europe/Bonn\" is not the name"));
  const ProgramResult misfit =
      init({"--preset", "wide", "--table", "telegraf.opcua", "--out", file("c.json")});
  EXPECT_EQ(misfit.exit_code, 2) << misfit.out;
  EXPECT_THAT(misfit.err, HasSubstr("what fits: --preset telegraf --table telegraf.opcua"));
  go_on_with("a.json");
  EXPECT_EQ(verdict_of("FIC101"), "valve_stiction\n");

  const std::string written = content_of(file("a.json"));
  const ProgramResult third = init({"--table", "telegraf.opcua", "--out", file("a.json")});
  EXPECT_EQ(third.exit_code, 2);
  EXPECT_THAT(third.err, AllOf(HasSubstr("exists already"), HasSubstr("--force")));
  EXPECT_EQ(content_of(file("a.json")), written);

  // Another table of the same historian: which one has to be said, and its grants are missing.
  const ProgramResult which = init({"--out", file("b.json")});
  EXPECT_EQ(which.exit_code, 2);
  EXPECT_THAT(which.out, AllOf(HasSubstr("telegraf.opcua: preset telegraf"),
                               HasSubstr("public.archive: preset narrow")));
  EXPECT_THAT(which.err, HasSubstr("--table"));
  const std::vector<std::string> archive{"--table", "archive",     "--name", "archive",
                                         "--sql",   folder.path(), "--out",  file("b.json")};
  const ProgramResult lacking = init(archive);
  EXPECT_EQ(lacking.exit_code, 4);
  EXPECT_THAT(lacking.out, HasSubstr("has no right to read it"));
  EXPECT_THAT(lacking.err, HasSubstr("run " + file("historian.sql") + ", then run this"));
  EXPECT_EQ(std::filesystem::status(file("historian.sql")).permissions(),
            std::filesystem::perms(0644));
  EXPECT_THAT(content_of(file("historian.sql")),
              EndsWith("GRANT USAGE ON SCHEMA \"public\" TO \"loopscope_historian_1\";\n"
                       "GRANT SELECT ON \"public\".\"archive\" TO \"loopscope_historian_1\";\n"));
  psql(*historian_server, "plant", "again.sql", content_of(file("historian.sql")));
  const ProgramResult last = init(archive);
  EXPECT_EQ(last.exit_code, 0) << last.out << last.err;
  loopscope("a.json", {"loops", "disable", "FIC101"});
  go_on_with("b.json");
  EXPECT_EQ(verdict_of("FIC201"), "valve_stiction\n");
  expect_every_connection_to_be_tried();
}

}  // namespace
}  // namespace loopscope::tests
