#include <fstream>
#include <gmock/gmock.h>

#include "tests/end_to_end/plant.hpp"

namespace loopscope::tests {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// As `id` names who runs this test.
std::string system_user() {
  const std::string name = run_program({"/usr/bin/id", "-run"}).out;
  return name.substr(0, name.find('\n'));
}

/// The log of work on loops, as a planner enters and reads it.
class MaintenanceTest : public testing::Test {
 protected:
  MaintenanceTest() {
    EXPECT_EQ(plant.loopscope("loops", {"add", "FIC101", "--pv-tag", "FIC101.PV"}).exit_code, 0);
  }
  [[nodiscard]] ProgramResult add(const std::string& loop, const std::string& at,
                                  const std::string& kind) const {
    return plant.loopscope("maintenance",
                           {"add", "--loop", loop, "--at", at, "--kind", kind, "new", "packing"});
  }
  [[nodiscard]] std::string entered() const {
    return plant.sql("SELECT count(*) FROM loopscope.maintenance_event");
  }
  Plant plant;
};

TEST_F(MaintenanceTest, WorkIsEnteredAndListed) {
  EXPECT_EQ(add("FIC101", "2026-03-01T14:30:00+01:00", "valve").out,
            "entered: FIC101 2026-03-01T13:30:00Z valve\n");
  const ProgramResult more =
      plant.loopscope("maintenance", {"add", "--loop", "FIC101", "--at", "2026-03-02", "--kind",
                                      "other", "--on-behalf-of", "J. Doe", "cleaned"});
  EXPECT_EQ(more.exit_code, 0) << more.err;
  const ProgramResult list = plant.loopscope("maintenance", {"list", "--loop", "FIC101"});
  EXPECT_EQ(list.exit_code, 0) << list.err;
  EXPECT_THAT(list.out, AllOf(HasSubstr("2026-03-01T13:30:00Z  -  FIC101  valve: new packing\n"),
                              HasSubstr("    Not judged yet: a running service judges it"),
                              HasSubstr("    Entered by J. Doe (login ")));
}

/// By the real user id, whatever the environment says.
TEST_F(MaintenanceTest, WithoutANameItIsEnteredInThatOfTheSystemsUser) {
  std::vector<std::string> words = plant.command_line("maintenance");
  words.insert(words.begin(), {"/usr/bin/env", "USER=boss", "LOGNAME=boss"});
  words.insert(words.end(),
               {"add", "--loop", "FIC101", "--at", "2026-03-01", "--kind", "valve", "x"});
  const ProgramResult entered = run_program(words);
  EXPECT_EQ(entered.exit_code, 0) << entered.err;
  EXPECT_EQ(plant.sql("SELECT on_behalf_of FROM loopscope.maintenance_event"), system_user());
}

TEST_F(MaintenanceTest, TimesAreThoseOfThePlant) {
  plant.write_settings(Plant::settings(R"("plant": {"time_zone": "Europe/Berlin"})"));
  EXPECT_EQ(add("FIC101", "2026-03-01 14:30", "valve").out,
            "entered: FIC101 2026-03-01T14:30:00+01:00 valve\n");
  EXPECT_EQ(add("FIC101", "2025-10-26T02:30+01:00", "valve").exit_code, 0);
  EXPECT_THAT(plant.loopscope("maintenance", {"list"}).out,
              AllOf(HasSubstr("2026-03-01T14:30:00+01:00  -  FIC101"),
                    HasSubstr("2025-10-26T02:30:00+01:00  -  FIC101")));
  EXPECT_EQ(plant.sql("SELECT max(done_at) AT TIME ZONE 'UTC' FROM loopscope.maintenance_event"),
            "2026-03-01 13:30:00");
  const ProgramResult twice = add("FIC101", "2025-10-26 02:30", "valve");
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_THAT(twice.err, HasSubstr("error: \"2025-10-26 02:30\" is two times in Europe/Berlin: "
                                   "the clock was put back from 03:00 CEST to 02:00 CET then "
                                   "(write the offset: 2025-10-26T02:30:00+02:00 (CEST) or "));
}

TEST_F(MaintenanceTest, APassJudgesIt) {
  EXPECT_EQ(add("FIC101", "2026-03-01 12:00", "valve").exit_code, 0);
  plant.import_loop("FIC101", 4096);
  const ProgramResult pass = plant.loopscope("once");
  EXPECT_EQ(pass.exit_code, 0) << pass.err;
  EXPECT_THAT(pass.err, HasSubstr("repairs: 1 judged"));
  EXPECT_THAT(
      plant.loopscope("maintenance", {"list"}).out,
      HasSubstr("    Cannot be compared: no usable window of the loop from before this work"));
}

TEST_F(MaintenanceTest, MistakesAreExplained) {
  const auto expect = [](const ProgramResult& result, int code, const std::string& what,
                         const std::string& hint) {
    EXPECT_EQ(result.exit_code, code);
    EXPECT_THAT(result.err,
                AllOf(HasSubstr("error: " + what), HasSubstr("HINT: "), HasSubstr(hint)));
  };
  expect(add("FIC110", "2026-03-01 12:00", "valve"), 2, "no loop named \"FIC110\"",
         "did you mean \"FIC101\"?");
  expect(add("FIC101", "2999-01-01 12:00", "valve"), 2,
         "work on \"FIC101\" at 2999-01-01T12:00:00Z", "without an offset is meant in UTC");
  expect(add("FIC101", "2026-03-01 12:00", "vavle"), 2,
         "no kind of work \"vavle\", did you mean valve", "maintenance add --help");
  expect(add("FIC101", "yesterday", "valve"), 2, "\"yesterday\" is not a time", "--help");
  expect(plant.loopscope("maintenance", {"list", "--loop", "x"}), 2, "no loop named \"x\"",
         "lists them");
  EXPECT_EQ(entered(), "0");
  EXPECT_EQ(add("FIC101", "2026-03-01 12:00", "valve").exit_code, 0);
  expect(add("FIC101", "2026-03-01 12:00", "valve"), 2, "work on \"FIC101\"",
         "shows what is entered");
  EXPECT_EQ(entered(), "1");
}

TEST_F(MaintenanceTest, ManyAtOnceAllOrNone) {
  const std::string file = plant.folder() / "work.csv";
  const auto load = [&](const std::string& last_loop) {
    std::ofstream(file) << "loop,at,kind,description\nFIC101,2026-03-01 12:00,valve,packing\n"
                        << last_loop << ",2026-03-02 12:00,tuning,\"slower, by half\"\n";
    return plant.loopscope("maintenance", {"load", file});
  };
  EXPECT_EQ(load("FIC102").exit_code, 2);
  EXPECT_EQ(entered(), "0");
  EXPECT_EQ(load("FIC101").out, "2 entered\n");
  EXPECT_EQ(entered(), "2");
}

}  // namespace
}  // namespace loopscope::tests
