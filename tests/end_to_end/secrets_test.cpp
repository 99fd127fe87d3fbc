#include <chrono>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>
#include <thread>

#include "tests/end_to_end/plant.hpp"
#include "tests/support/environment.hpp"
#include "tests/support/tls_server.hpp"

namespace loopscope::tests {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kSecret = "Zq9-geheim-77";
constexpr const char* kWrong = "Xk3-geheim-55";

/// The program with logins that need a password and TLS, as a site would have them.
class Secrets : public testing::Test {
 protected:
  void SetUp() override {
    server_.execute("CREATE DATABASE plant");
    const std::string password = std::string(" LOGIN PASSWORD '") + kSecret + "'";
    for (const char* login : {"p_owner", "p_worker", "p_historian"})
      server_.execute("CREATE ROLE " + std::string(login) + password);
    psql(content_of(source_dir() / "deploy" / "roles.sql"));
    psql(
        "GRANT loopscope_owner TO p_owner; GRANT loopscope_worker TO p_worker;"
        "GRANT loopscope_historian TO p_historian");
    write("pgpass", std::string("*:*:*:*:") + kSecret + "\n", 0600);
    write("wrong", std::string("*:*:*:*:") + kWrong + "\n", 0600);
    write("open", std::string("*:*:*:*:") + kSecret + "\n", 0644);
    write("service.conf",
          service("owner", "p_owner") + service("worker", "p_worker") +
              service("historian", "p_historian") + "[with_password]\npassword=" + kSecret + "\n" +
              service("", "p_worker"),
          0600);
    service_file_.emplace("PGSERVICEFILE", folder_.path() / "service.conf");
    password_file_.emplace("PGPASSFILE", folder_.path() / "pgpass");
    write_settings("service=worker", "service=historian");
  }

  void psql(const std::string& sql) const {
    const ProgramResult done = run_program({"/usr/bin/psql", "-Xq", "-v", "ON_ERROR_STOP=1", "-d",
                                            server_.superuser() + " dbname=plant", "-c", sql});
    ASSERT_EQ(done.exit_code, 0) << done.err;
  }

  void write(const std::string& name, const std::string& text, unsigned mode) const {
    std::ofstream(folder_.path() / name) << text;
    std::filesystem::permissions(folder_.path() / name, std::filesystem::perms(mode));
  }

  [[nodiscard]] std::string service(const std::string& name, const std::string& user) const {
    return (name.empty() ? "" : "[" + name + "]\n") +
           "host=localhost\nport=" + std::to_string(server_.port()) +
           "\ndbname=plant\nuser=" + user +
           "\nsslmode=verify-full\nsslrootcert=" + server_.certificate("authority") + "\n";
  }

  void write_settings(const std::string& results, const std::string& historian) const {
    write("loopscope.json",
          R"({"results": {"connection": ")" + results +
              R"(", "owner_connection": "service=owner"}, "historians": [{"connection": ")" +
              historian + R"(", "writer_connection": ")" + server_.superuser() +
              R"( dbname=plant"}], "schedule": {"poll_s": 0.5}})",
          0600);
  }

  [[nodiscard]] std::vector<std::string> command(const std::string& name) const {
    return {LOOPSCOPE_PROGRAM, name, "--config", folder_.path() / "loopscope.json"};
  }

  /// Runs a command and makes sure that no secret comes out of it.
  [[nodiscard]] ProgramResult loopscope(const std::string& name,
                                        const std::vector<std::string>& rest = {}) const {
    std::vector<std::string> arguments = command(name);
    arguments.insert(arguments.end(), rest.begin(), rest.end());
    ProgramResult result = run_program(arguments);
    EXPECT_THAT(result.out + result.err, AllOf(Not(HasSubstr(kSecret)), Not(HasSubstr(kWrong))));
    return result;
  }

  void expect_failure(const std::string& connection, int exit_code,
                      const std::string& words) const {
    SCOPED_TRACE(connection);
    write_settings(connection, "service=historian");
    for (const char* name : {"once", "check-config"}) {
      const ProgramResult result = loopscope(name);
      EXPECT_EQ(result.exit_code, exit_code) << result.err;
      EXPECT_THAT(result.out + result.err, HasSubstr(words));
      EXPECT_THAT(result.out + result.err, HasSubstr("HINT: "));
    }
  }

  /// The daemon works with these passwords; meanwhile nobody sees them.
  void expect_hidden_while_running() const {
    const std::string log = folder_.path() / "log";
    BackgroundProgram daemon(command("run"), log);
    std::string sessions;
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (sessions.find("loopscope/results") == std::string::npos &&
           std::chrono::steady_clock::now() < give_up) {
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
      sessions = run_program({"/usr/bin/psql", "-XAt", "-d", server_.superuser(), "-c",
                              "SELECT s FROM pg_stat_activity AS s"})
                     .out;
    }
    EXPECT_THAT(sessions, AllOf(HasSubstr("loopscope/results"), Not(HasSubstr(kSecret))));
    std::string processes;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
      const std::string name = entry.path().filename();
      if (name.find_first_not_of("0123456789") == std::string::npos)
        processes += content_of(entry.path() / "cmdline") + '\n';
    }
    EXPECT_THAT(processes, AllOf(HasSubstr("loopscope.json"), Not(HasSubstr(kSecret))));
    daemon.send(15);
    EXPECT_EQ(daemon.wait(20), 0);
    EXPECT_THAT(content_of(log), AllOf(HasSubstr("started"), Not(HasSubstr(kSecret))));
  }

  TlsServer server_;
  TemporaryFolder folder_;
  std::optional<EnvironmentVariable> service_file_, password_file_;
};

TEST_F(Secrets, WorkFromPgpassAndServiceFilesAndAreNeverShown) {
  ASSERT_EQ(loopscope("migrate").exit_code, 0);
  const std::string csv = folder_.path() / "r.csv";
  std::ofstream(csv) << noisy_loop_csv(600, 1);
  psql(
      "CREATE TABLE public.history (tag text NOT NULL, time timestamptz NOT NULL,"
      " value double precision, quality smallint);"
      "CREATE INDEX ON public.history (tag, time) INCLUDE (value, quality);"
      "GRANT USAGE ON SCHEMA public TO loopscope_historian;"
      "GRANT SELECT ON public.history TO loopscope_historian");
  ASSERT_EQ(loopscope("import", {"--loop", "FIC1", csv}).exit_code, 0);
  const ProgramResult pass = loopscope("once");
  EXPECT_EQ(pass.exit_code, 0) << pass.err;
  const ProgramResult check = loopscope("check-config");
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
  EXPECT_THAT(check.out, Not(HasSubstr("PROBLEM")));
  expect_hidden_while_running();

  write_settings("service=with_password", "service=historian");
  {
    const EnvironmentVariable none("PGPASSFILE", "/nowhere");
    EXPECT_EQ(loopscope("migrate").exit_code, 4) << "the owner's password is in no service file";
    EXPECT_EQ(loopscope("once").exit_code, 4);  // the historian's neither
    EXPECT_THAT(loopscope("check-config").out,
                AllOf(HasSubstr("connected to the results database (service=with_password)"),
                      HasSubstr("the password file /nowhere does not exist")));
  }
  expect_failure("service=worker host=127.0.0.1", 4, "does not match host name");
  expect_failure("service=worker sslrootcert=" + server_.certificate("other"), 4,
                 "certificate verify failed");
  expect_failure("service=worker port=1", 4, "port=1");
  expect_failure("service=worker port=70000", 4, "70000");
  expect_failure("service=worker host=no-such-host.invalid", 4, "no-such-host.invalid");
  write_settings("service=worker host=no-such-host.invalid sslmode=require", "service=historian");
  EXPECT_THAT(loopscope("check-config").out,
              HasSubstr("warning  results database: the connection to the remote host"
                        " no-such-host.invalid has sslmode=require: anybody on the way can pose"));
  expect_failure("service=worker dbname=nothing", 4, "nothing");
  expect_failure("service=worker user=nobody", 4, "nobody");
  expect_failure("service=none", 4, "definition of service \"none\" not found");
  expect_failure("service=worker sslmode=odd", 4, "sslmode");
  expect_failure("service=worker odd=1", 4, "odd");
  expect_failure("service=worker passfile=" + (folder_.path() / "wrong").string(), 4,
                 "password authentication failed");
  expect_failure("service=worker passfile=" + (folder_.path() / "open").string(), 4,
                 "one that others may read is ignored");
  const std::string secret = kSecret;
  expect_failure("service=worker password=" + secret, 3, "holds a password");
  expect_failure("postgresql://p_worker:" + secret + "@localhost/plant", 3, "holds a password");
  expect_failure("postgresql://p_worker:" + secret + "/plant", 3, "text where a port");
  expect_failure("dbname='postgresql://p_worker:" + secret + "@localhost/plant'", 4, "dbname=");
  expect_failure("dbname=p_worker:" + secret + "@localhost/plant", 4, "dbname=");
  expect_failure("service=p_worker:" + secret + "@localhost", 4, "service=");
  expect_failure("service=worker user='p_worker:" + secret + "'", 4, "user=");
  expect_failure("service=worker host=p_worker:" + secret + "@localhost", 4, "host=");
}

}  // namespace
}  // namespace loopscope::tests
