#include "core/model/residual_tests/statistics/change_point.hpp"

#include <gtest/gtest.h>

#include "tests/core/model/residual_tests/loops.hpp"

namespace loopscope::core::model {
namespace {

TEST(ChangePoint, FindsAShiftAndItsSize) {
  tests::Series r = tests::white(tests::White::gaussian, 4096, 1);
  for (std::size_t k = 1500; k < r.size(); ++k) r[k] += 0.5;
  const ChangePoint change = find_change(r);
  EXPECT_LT(change.p, 1e-10);
  EXPECT_NEAR(static_cast<double>(change.at_sample), 1500.0, 30.0);
  EXPECT_NEAR(change.after - change.before, 0.5, 0.1);
}

TEST(ChangePoint, MissingSamplesTakeNoTime) {
  const tests::Series r = tests::white(tests::White::gaussian, 1000, 2);
  tests::Series gap = r;
  gap.insert(gap.begin() + 400, 700, 0.0);
  EXPECT_DOUBLE_EQ(find_change(gap).p, find_change(r).p);
  EXPECT_EQ(find_change(tests::Series(100, 0.0)).p, 1.0);
  EXPECT_EQ(find_change({}).p, 1.0);
}

}  // namespace
}  // namespace loopscope::core::model
