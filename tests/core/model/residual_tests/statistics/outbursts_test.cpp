#include "core/model/residual_tests/statistics/outbursts.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/core/model/residual_tests/loops.hpp"

namespace loopscope::core::model {
namespace {

TEST(Outbursts, SeveralLargeOnesDoNotHideEachOther) {
  tests::Series r = tests::white(tests::White::gaussian, 4096, 1);
  for (const std::size_t k : {700U, 1840U, 3000U}) r[k] += 10.0;
  const Outbursts found = find_outbursts(r);
  EXPECT_LT(found.p, 1e-3);
  ASSERT_EQ(found.events.size(), 3U);
  for (const Outburst& event : found.events) {
    EXPECT_EQ(event.samples, 1U);
    EXPECT_TRUE(event.at_sample == 700 || event.at_sample == 1840 || event.at_sample == 3000);
  }
}

TEST(Outbursts, AClusterIsSeenWhole) {
  tests::Series r = tests::white(tests::White::gaussian, 4096, 3);
  for (std::size_t j = 0; j < 16; ++j) r[2000 + j] += 3.5;
  const Outbursts found = find_outbursts(r);
  EXPECT_LT(found.p, 0.01);
  ASSERT_FALSE(found.events.empty());
  EXPECT_GE(found.events[0].samples, 8U);
  EXPECT_NEAR(static_cast<double>(found.events[0].at_sample), 2000.0, 10.0);
}

TEST(Outbursts, NothingInNothing) {
  EXPECT_EQ(find_outbursts(tests::Series(500, 0.0)).p, 1.0);
  EXPECT_EQ(find_outbursts({}).p, 1.0);
}

}  // namespace
}  // namespace loopscope::core::model
