#include "daemon/lab/calibrate/cost.hpp"

#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

TEST(Cost, IsTheMeanOfARecord) {
  std::vector<FamilyTally> tallies(2);
  tallies[0].estimate_s = 0.1;
  tallies[1].estimate_s = 0.3;
  tallies[0].analyse_s = 0.2;
  tallies[1].analyse_s = 1.8;
  const Cost cost = mean_cost(tallies, 1000);
  EXPECT_DOUBLE_EQ(cost.estimate_us, 200.0);
  EXPECT_DOUBLE_EQ(cost.analyse_us, 1000.0);
  EXPECT_DOUBLE_EQ(cost.ratio(), 5.0);
}

}  // namespace
}  // namespace loopscope::daemon
