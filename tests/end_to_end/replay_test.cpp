#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "tests/end_to_end/plant.hpp"

namespace loopscope::tests {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

/// Simulated loops that were analysed once: one with a loop model that took in an effect, one of
/// noise.
class Replay : public testing::Test {
 protected:
  void SetUp() override {
    const std::string file = plant.folder() / "sticking.csv";
    ASSERT_EQ(run_program({plant.command_line("simulate")[0], "simulate", "sticking_valve",
                           "--seed", "3", "--out", file})
                  .exit_code,
              0);
    ASSERT_EQ(plant.loopscope("import", {"--create-table", "--loop", "FIC1", file}).exit_code, 0);
    plant.import_loop("FIC2");
    ASSERT_EQ(plant.loopscope("once").exit_code, 0);
  }
  [[nodiscard]] ProgramResult replay(const std::string& loop) const {
    return plant.loopscope("replay", {plant.sql("select analysis_id from loopscope.latest_verdict "
                                                "where loop_name = '" +
                                                loop + "'")});
  }
  Plant plant;
};

TEST_F(Replay, OfTheSameRowsIsIdenticalToTheLastDigit) {
  EXPECT_NE(plant.sql("select count(*) from loopscope.explanation_step"), "0");
  for (const char* loop : {"FIC1", "FIC2"}) {
    const ProgramResult again = replay(loop);
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_THAT(again.out, HasSubstr("identical: all"));
    EXPECT_THAT(again.out, Not(HasSubstr("differs")));
    EXPECT_THAT(again.out, ContainsRegex("window end +[-0-9]+T[0-9:]+Z\n"));
  }
  plant.write_settings(Plant::settings(R"("plant": {"time_zone": "Asia/Kolkata"})"));
  EXPECT_THAT(replay("FIC2").out, ContainsRegex("window end +[-0-9]+T[0-9:]+[+]05:30\n"));
}

TEST_F(Replay, TellsOfOtherRowsAndNamesTheFarthestFigure) {
  plant.sql("update history set value = value * 2 where tag = 'FIC2.PV'");
  const ProgramResult again = replay("FIC2");
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_THAT(again.out, HasSubstr("input         differs"));
  EXPECT_THAT(again.out, HasSubstr("figures differ, the farthest"));
}

TEST_F(Replay, UsesTheSettingsOfThatTime) {
  plant.write_settings(
      Plant::settings(R"("analysis": {"window_samples": 512, "fit_model": false})"));
  EXPECT_THAT(replay("FIC1").out, HasSubstr("identical: all"));
}

TEST_F(Replay, WhatIsGoneIsSaidWithItsCode) {
  const ProgramResult unknown = plant.loopscope("replay", {"999999"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("HINT:"));
  plant.sql("delete from history where tag = 'FIC2.PV'");
  const ProgramResult gone = replay("FIC2");
  EXPECT_EQ(gone.exit_code, 5);
  EXPECT_THAT(gone.err, HasSubstr("has no row of FIC2.PV"));
}

}  // namespace
}  // namespace loopscope::tests
