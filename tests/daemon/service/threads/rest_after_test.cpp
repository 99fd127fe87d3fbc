#include "daemon/service/threads/rest_after.hpp"

#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

TEST(RestAfter, IsTwentyTimesTheLookWithinLimits) {
  using std::chrono::minutes;
  using std::chrono::seconds;
  EXPECT_EQ(rest_after(seconds(1), minutes(1)), minutes(1));
  EXPECT_EQ(rest_after(seconds(15), minutes(1)), minutes(5));
  EXPECT_EQ(rest_after(minutes(5), minutes(1)), minutes(10)) << "it waited for something";
  EXPECT_EQ(rest_after(seconds(15), minutes(60)), minutes(60));
}

}  // namespace
}  // namespace loopscope::daemon
