#include "tests/plants/score_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace loopscope::tests::plants {
namespace {

PlantScore score_of(std::size_t right, std::size_t false_flags) {
  PlantScore score;
  score.loops = 500;
  score.faulty = 25;
  score.right = right;
  score.false_flags = false_flags;
  score.by_fault["valve_stiction"] = {25, right, 0, 0};
  score.misses = {"L001 healthy_still: tight_tuning"};
  return score;
}

TEST(ScoreText, TheFigureAsksFor22RightAndTwoFalseAtMost) {
  EXPECT_TRUE(holds(score_of(22, 2)));
  EXPECT_FALSE(holds(score_of(21, 0)));
  EXPECT_FALSE(holds(score_of(25, 3)));
}

TEST(ScoreText, JsonHasThePlantsAndTheirFaults) {
  const auto json = nlohmann::json::parse(json_of({{7, score_of(24, 1)}, {8, score_of(20, 0)}}));
  EXPECT_EQ(json["holding"], 1);
  EXPECT_EQ(json["plants"][0]["seed"], 7);
  EXPECT_EQ(json["plants"][0]["right"], 24);
  EXPECT_EQ(json["plants"][0]["false"], 1);
  EXPECT_EQ(json["faults"]["valve_stiction"]["faulty"], 50);
}

TEST(ScoreText, TheTableNamesWhatWasMissed) {
  EXPECT_THAT(table_of({{7, score_of(24, 1)}}), testing::HasSubstr("7 L001 healthy_still"));
}

TEST(ScoreText, FlagsAreNamesAndVerdicts) {
  std::istringstream lines("L001 tight_tuning\nL500 sensor_fault\n");
  EXPECT_EQ(read_flags(lines), (Flags{{"L001", "tight_tuning"}, {"L500", "sensor_fault"}}));
  std::istringstream wrong("L001 tight tuning\n");
  EXPECT_THROW(static_cast<void>(read_flags(wrong)), std::invalid_argument);
}

}  // namespace
}  // namespace loopscope::tests::plants
