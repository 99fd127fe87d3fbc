#include "config/nearest_name.hpp"

#include <gtest/gtest.h>

namespace loopscope::config::tests {
namespace {

TEST(NearestName, DistanceCountsSlipsOfThePen) {
  EXPECT_EQ(spelling_distance("poll_s", "poll_s"), 0U);
  EXPECT_EQ(spelling_distance("Poll_S", "poll_s"), 0U);
  EXPECT_EQ(spelling_distance("pol_s", "poll_s"), 1U);
  EXPECT_EQ(spelling_distance("polll_s", "poll_s"), 1U);
  EXPECT_EQ(spelling_distance("pall_s", "poll_s"), 1U);
  EXPECT_EQ(spelling_distance("opll_s", "poll_s"), 1U);
  EXPECT_EQ(spelling_distance("", "poll_s"), 6U);
  EXPECT_EQ(spelling_distance("abc", ""), 3U);
}

TEST(NearestName, DistanceIsSymmetric) {
  EXPECT_EQ(spelling_distance("kitten", "sitting"), 3U);
  EXPECT_EQ(spelling_distance("sitting", "kitten"), 3U);
}

TEST(NearestName, NearestOfSeveral) {
  const std::vector<std::string> known = {"lease_s", "settle_s", "poll_s"};
  EXPECT_EQ(nearest_name("setle_s", known), "settle_s");
  EXPECT_EQ(nearest_name("lease", known), std::nullopt);
  EXPECT_EQ(nearest_name("leas_s", known), "lease_s");
}

TEST(NearestName, StrangersAreNotNear) {
  EXPECT_EQ(nearest_name("colour", {"workers", "log_level"}), std::nullopt);
  EXPECT_EQ(nearest_name("x", {"y"}), "y");
  EXPECT_EQ(nearest_name("", {"abc"}), std::nullopt);
  EXPECT_EQ(nearest_name(std::string(100000, 'a'), {"a"}), std::nullopt);
}

}  // namespace
}  // namespace loopscope::config::tests
