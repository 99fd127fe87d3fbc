#include "tests/plants/plant_score.hpp"

#include <gtest/gtest.h>
#include <stdexcept>

namespace loopscope::tests::plants {
namespace {

std::vector<PlantLoop> plant() {
  return {{"L001", "healthy_still", 1, "", 1.0},
          {"L002", "valve_stiction", 2, "valve_stiction", 1.0},
          {"L003", "tight_moving", 3, "tight_tuning", 1.0},
          {"L004", "sensor_hold", 4, "sensor_fault", 1.0}};
}

TEST(PlantScore, RightIsTheVerdictOfTheKind) {
  const PlantScore result = score(
      plant(), {{"L002", "valve_stiction"}, {"L003", "tight_tuning"}, {"L004", "sensor_fault"}});
  EXPECT_EQ(result.loops, 4U);
  EXPECT_EQ(result.faulty, 3U);
  EXPECT_EQ(result.right, 3U);
  EXPECT_EQ(result.false_flags, 0U);
  EXPECT_TRUE(result.misses.empty());
}

TEST(PlantScore, AHealthyLoopOnTheListIsFalseWhateverIsSaidOfIt) {
  for (const char* verdict : {"valve_stiction", "unexplained"}) {
    const PlantScore result = score(plant(), {{"L001", verdict}});
    EXPECT_EQ(result.false_flags, 1U);
    EXPECT_EQ(result.false_healthy, 1U);
    EXPECT_EQ(result.misses.size(), 4U);
  }
}

TEST(PlantScore, AFaultyLoopThatIsAccusedOfSomethingElseIsFalseToo) {
  const PlantScore result = score(plant(), {{"L002", "valve_deadband"}});
  EXPECT_EQ(result.right, 0U);
  EXPECT_EQ(result.false_flags, 1U);
  EXPECT_EQ(result.false_healthy, 0U);
  EXPECT_EQ(result.by_fault.at("valve_stiction").wrong, 1U);
}

TEST(PlantScore, AnAdmittedIgnoranceIsNeitherRightNorFalse) {
  const PlantScore result = score(plant(), {{"L002", "nonlinear_unexplained"}});
  EXPECT_EQ(result.right, 0U);
  EXPECT_EQ(result.false_flags, 0U);
  EXPECT_EQ(result.by_fault.at("valve_stiction").unnamed, 1U);
}

TEST(PlantScore, AForeignLoopIsRefused) {
  EXPECT_THROW(static_cast<void>(score(plant(), {{"X", "healthy"}})), std::invalid_argument);
}

}  // namespace
}  // namespace loopscope::tests::plants
