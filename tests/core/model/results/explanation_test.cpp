#include "core/model/results/explanation.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace loopscope::core::model {
namespace {

double explained(double before, double after) {
  Step step;
  step.holdout_error_before = before;
  step.holdout_error_after = after;
  return explained_by(step);
}

TEST(Explanation, WhatAStepExplainsIsTheLogarithmOfItsDrop) {
  EXPECT_DOUBLE_EQ(explained(1.0, 0.5), std::log(2.0));
  EXPECT_EQ(explained(1.0, 1.2), 0.0);
  EXPECT_EQ(explained(0.0, 0.0), 0.0);
  EXPECT_EQ(explained(1.0, 0.0), 0.0);
  EXPECT_EQ(explained(std::numeric_limits<double>::quiet_NaN(), 1.0), 0.0);
}

}  // namespace
}  // namespace loopscope::core::model
