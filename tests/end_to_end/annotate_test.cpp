#include <csignal>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/end_to_end/told_plant.hpp"
#include "tests/support/hostile_names.hpp"

namespace loopscope::tests {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

class Annotate : public testing::Test {
 protected:
  [[nodiscard]] ProgramResult annotate(const std::vector<std::string>& rest) const {
    return plant.plant().loopscope("annotate", rest);
  }
  [[nodiscard]] std::string flagged() const {
    return plant.plant().sql("SELECT loop_name FROM loopscope.flagged_loop ORDER BY loop_name");
  }
  void expect_error(const std::vector<std::string>& rest, const std::string& words,
                    const std::string& hint) const {
    const ProgramResult result = annotate(rest);
    EXPECT_EQ(result.exit_code, 2) << words;
    EXPECT_THAT(result.err, HasSubstr(words));
    EXPECT_THAT(result.err, HasSubstr("HINT: " + hint));
  }
  ToldPlant plant;
};

TEST_F(Annotate, TakesLoopsOffTheListAndPutsThemBack) {
  EXPECT_EQ(flagged(), "FIC101\nNEW1\nPIC200");
  const ProgramResult known =
      annotate({"--loop", "FIC101", "acknowledge", "--reason", "order 4712"});
  EXPECT_EQ(known.exit_code, 0) << known.err;
  EXPECT_EQ(
      known.out,
      "acknowledged FIC101, verdict valve_stiction, until work done since is entered "
      "(loopscope maintenance) and a window lies wholly after it, or until it is withdrawn\n");
  EXPECT_EQ(flagged(), "NEW1\nPIC200");
  EXPECT_EQ(
      annotate({"--loop", "PIC200", "suppress", "--until", "2199-01-01", "--reason", "turnaround"})
          .exit_code,
      0);
  EXPECT_EQ(flagged(), "NEW1");
  EXPECT_EQ(annotate({"--loop", "NEW1", "false-positive", "--code", "any"}).exit_code, 0);
  EXPECT_EQ(flagged(), "");
  const std::string list = annotate({"list"}).out;
  for (const char* words :
       {"order 4712", "2199-01-01T00:00:00Z", "turnaround", "false_positive", "order 4711"}) {
    EXPECT_THAT(list, HasSubstr(words));
  }
  EXPECT_THAT(annotate({"--loop", "NEW1", "list"}).out,
              AllOf(HasSubstr("NEW1"), Not(HasSubstr("PIC200"))));
  plant.plant().write_settings(Plant::settings(R"("plant": {"time_zone": "Asia/Kolkata"})"));
  EXPECT_THAT(annotate({"list"}).out, HasSubstr("2199-01-01T05:30:00+05:30"));
  EXPECT_THAT(
      annotate({"--loop", "PIC200", "suppress", "--until", "2199-01-01", "--reason", "x"}).out,
      HasSubstr("until 2199-01-01T00:00:00+05:30"));
  for (const char* loop : {"FIC101", "PIC200", "NEW1"})
    EXPECT_EQ(annotate({"--loop", loop, "withdraw"}).exit_code, 0);
  EXPECT_EQ(flagged(), "FIC101\nNEW1\nPIC200");
}

TEST_F(Annotate, OfAKindOneStands) {
  EXPECT_EQ(
      annotate({"--loop", "FIC101", "acknowledge", "--reason", "seen", "--on-behalf-of", "J. Doe"})
          .exit_code,
      0);
  EXPECT_THAT(annotate({"--loop", "FIC101", "acknowledge", "--reason", "ordered"}).out,
              ContainsRegex(
                  "\n  takes the place of what was in force already: acknowledged by "
                  "J\\. Doe \\(login [^)]+\\) since [-0-9T:]+Z, verdict valve_stiction: seen\n$"));
  EXPECT_EQ(plant.plant().sql("SELECT count(*) FROM loopscope.annotation_in_force"
                              " WHERE loop_name = 'FIC101'"),
            "1");
  EXPECT_THAT(
      annotate({"--loop", "FIC101", "suppress", "--until", "2199-01-01", "--reason", "x"}).out,
      AllOf(HasSubstr("\n  stands beside what is in force already: acknowledged by "),
            HasSubstr(", verdict valve_stiction: ordered\n"), HasSubstr("takes back all that")));
}

TEST_F(Annotate, ErrorsSayTheWayOut) {
  expect_error({"--loop", "FIC10", "acknowledge"}, "no loop named \"FIC10\"",
               "did you mean \"FIC101\"?");
  expect_error({"--loop", "zzz", "withdraw"}, "no loop named", "loopscope loops");
  expect_error({"acknowledge"}, "--loop is missing", "name the loop");
  expect_error({"--loop", "TIC400", "acknowledge"}, "its newest verdict is healthy",
               "name the verdict that is meant");
  expect_error({"--loop", "FIC101", "acknowledge", "--code", "valve_sticktion"},
               "is not the verdict of a fault", "did you mean valve_stiction?");
  expect_error({"--loop", "FIC101", "suppress", "--until", "2020-01-01", "--reason", "x"},
               "--until 2020-01-01T00:00:00Z has passed", "name a time to come");
  expect_error({"--loop", "FIC101", "suppress", "--until", "soon", "--reason", "x"},
               "is not a time", "write ISO 8601");
  expect_error({"--loop", "FIC101", "suppress", "--until", "2199-01-01", "--reason", ""},
               "--reason is empty", "say why");
  expect_error({"--loop", "FIC101", "suppress", "--until", "2199-01-01"}, "--reason is required",
               "see loopscope");
  expect_error({"--loop", "FIC103", "withdraw"}, "nothing to withdraw", "loopscope annotate");
  expect_error({}, "A subcommand is required", "see loopscope");
}

/// One login for all, as it is meant: the settings name it, and everybody speaks in his own name.
TEST_F(Annotate, EverybodySpeaksInHisOwnNameUnderOneLogin) {
  const std::string login = "ls_engineer_" + std::to_string(getpid());
  plant.plant().sql("CREATE ROLE " + login + " LOGIN IN ROLE loopscope_engineer");
  plant.plant().write_settings(
      R"({"results": {"connection": "@RESULTS@", "engineer_connection": ")" +
      plant.plant().connection() + " user=" + login +
      R"("}, "historians": [{"connection": "@CONNECTION@"}]})");
  EXPECT_THAT(
      plant.plant().loopscope("check-config").out,
      HasSubstr("ok       results database, engineer: the engineer has INSERT (on_behalf_of)"
                " on loopscope.annotation"));
  const std::string odd = "J. M\u00fcller <i>'\"{}";
  EXPECT_EQ(annotate({"--loop", "FIC101", "acknowledge", "--on-behalf-of", odd}).exit_code, 0);
  EXPECT_EQ(annotate({"--loop", "PIC200", "acknowledge"}).exit_code, 0);
  EXPECT_THAT(annotate({"list"}).out, HasSubstr(odd + " (login " + login + ")"));
  EXPECT_EQ(plant.plant().sql("SELECT author FROM loopscope.hidden_loop WHERE on_behalf_of = " +
                              sql_text(odd)),
            login);
  EXPECT_EQ(annotate({"--loop", "FIC101", "withdraw", "--on-behalf-of", "Eve"}).exit_code, 0);
  EXPECT_EQ(plant.plant().sql("SELECT withdrawn_by || ' for ' || withdrawn_on_behalf_of FROM"
                              " loopscope.annotation_history WHERE on_behalf_of LIKE 'J. M%'"),
            login + " for Eve");
  for (const char* name : {"", " x", "a\nb", "\x1b[2J"}) {
    const ProgramResult refused =
        annotate({"--loop", "FIC101", "acknowledge", "--on-behalf-of", name});
    EXPECT_EQ(refused.exit_code, 2) << name;
    EXPECT_THAT(refused.err, AllOf(HasSubstr("error: --on-behalf-of "), HasSubstr("HINT: ")));
    EXPECT_TRUE(is_harmless_on_a_terminal(refused.err)) << refused.err;
  }
  plant.plant().sql("DROP ROLE " + login);
}

TEST_F(Annotate, WhoMayNotIsToldOfTheRole) {
  const std::string login = "anna_" + std::to_string(getpid());
  plant.plant().sql("CREATE ROLE " + login + " LOGIN IN ROLE loopscope_reader");
  const std::string mine = plant.plant().connection() + " user=" + login;
  plant.plant().write_settings(R"({"results": {"connection": ")" + mine +
                               R"("}, "historians": [{"connection": "@CONNECTION@"}]})");
  const ProgramResult refused = annotate({"--loop", "FIC101", "acknowledge"});
  EXPECT_EQ(refused.exit_code, 4);
  EXPECT_THAT(refused.err, HasSubstr("loopscope_engineer to annotate"));
  plant.plant().sql("GRANT loopscope_engineer TO " + login);
  EXPECT_EQ(annotate({"--loop", "FIC101", "acknowledge"}).exit_code, 0);
  EXPECT_EQ(plant.plant().sql("SELECT author FROM loopscope.annotation_in_force"
                              " WHERE loop_name = 'FIC101'"),
            login);
  plant.plant().sql("DROP ROLE " + login);
}

/// The pages, behind a proxy at 127.0.0.2, asked by hostile_forms.py. Loops rest: their verdicts
/// are those that were told.
class AnnotateOnPages : public Annotate {
 protected:
  void SetUp() override {
    const std::string evil =
        R"(<script>alert(1)</script>"><img src=x onerror=alert(1)>'; DROP TABLE )"
        "loopscope.annotation; --";
    plant.plant().sql("CREATE ROLE " + login + " LOGIN IN ROLE loopscope_engineer");
    plant.plant().sql(
        "INSERT INTO loopscope.loop (name, source, pv_tag, interval_s, period_s)"
        " VALUES (" +
        sql_text(evil) + ", 'plant', 'x', 10, 3600)");
    plant.plant().sql(
        "UPDATE loopscope.loop SET period_s = 2592000;"
        "UPDATE loopscope.schedule SET visible_at = now() + interval '20 days'");
  }
  void TearDown() override { plant.plant().sql("DROP ROLE " + login); }

  void write_settings(const std::string& acknowledge) const {
    plant.plant().write_settings(
        R"({"results": {"connection": "@RESULTS@", "engineer_connection": ")" +
        plant.plant().connection() + " user=" + login + R"("}, "daemon": {"http_address": )" +
        R"("127.0.0.1:0", "acknowledge": {)" + acknowledge +
        R"(}}, "historians": [{"connection": "@CONNECTION@"}]})");
  }
  /// With these settings of /daemon/acknowledge; what the script says.
  void send_forms(const std::string& mode, const std::string& settings) const {
    write_settings(settings);
    const std::filesystem::path log = plant.plant().folder() / (mode + ".log");
    BackgroundProgram daemon(plant.plant().command_line("run"), log);
    const std::string address = pages_of(log);
    ASSERT_NE(address, "") << content_of(log);
    const ProgramResult sent = run_program(
        {"/usr/bin/python3", source_dir() / "tests/end_to_end/hostile_forms.py", mode,
         address.substr(address.rfind(':') + 1), origin, plant.plant().connection(), login});
    EXPECT_EQ(sent.exit_code, 0) << sent.err << content_of(log);
    daemon.send(SIGTERM);
    EXPECT_EQ(daemon.wait(30), 0);
    EXPECT_TRUE(is_harmless_on_a_terminal(content_of(log)));
  }

  const std::string login = "ls_pages_" + std::to_string(getpid());
  const std::string origin = "https://loopscope.plant.example";
};

TEST_F(AnnotateOnPages, NothingThatABrowserSendsChangesAnythingWhileItIsOff) {
  send_forms("off", R"("origin": ")" + origin + R"(")");
}

TEST_F(AnnotateOnPages, OnlyWhoIsSignedInWritesAndOnlyFromThePage) {
  send_forms("on", R"("trusted_proxies": ["127.0.0.2"], "origin": ")" + origin + R"(")");
  EXPECT_THAT(
      plant.plant().loopscope("check-config").out,
      HasSubstr("ok       acknowledging on the pages: is on: who comes by 127.0.0.2 is whom "
                "X-Remote-User names, and sees the pages under " +
                origin));
  EXPECT_THAT(content_of(plant.plant().folder() / "on.log"),
              AllOf(HasSubstr("entered from a page: acknowledged FIC101, verdict valve_stiction"),
                    HasSubstr(", by anna, proxy 127.0.0.2"), HasSubstr("withdrawn from a page: "),
                    HasSubstr("not entered from a page: "),
                    HasSubstr("entered from a page, and its answer was cut short: ")));
  write_settings(R"("trusted_proxies": ["128.0.0.0/7", "10.0.0.0/8", "fd00::/8"], "origin": ")" +
                 origin + R"(")");
  EXPECT_THAT(
      plant.plant().loopscope("check-config").out,
      AllOf(HasSubstr("128.0.0.0/7 is a very wide network to trust"),
            HasSubstr("fd00::/8 is a very wide network"), Not(HasSubstr("10.0.0.0/8 is a"))));
}

}  // namespace
}  // namespace loopscope::tests
