#include "core/model/residual_tests/tests/coupling.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/core/model/residual_tests/loops.hpp"

namespace loopscope::core::model {
namespace {

using tests::White;

TEST(Coupling, IsAskedWithTheSeed) {
  const tests::Series skewed = tests::white(White::exponential, 4096, 9);
  const auto a = test_coupling(skewed, 3), b = test_coupling(skewed, 3);
  EXPECT_LT(tests::p_of(a, "ngi"), 1e-3) << "skewed noise";
  EXPECT_GT(tests::p_of(a, "nonlinear"), 0.01) << "is not nonlinear";
  EXPECT_EQ(tests::p_of(a, "nonlinear"), tests::p_of(b, "nonlinear"));
}

TEST(Coupling, TooFewSamplesHaveNoAnswer) {
  EXPECT_TRUE(test_coupling(tests::white(White::gaussian, 199, 1), 3).empty());
  EXPECT_FALSE(test_coupling(tests::white(White::gaussian, 400, 1), 3).empty());
  tests::Series gappy = tests::white(White::gaussian, 400, 1);
  for (std::size_t k = 150; k < 400; ++k) gappy[k] = std::nan("");
  EXPECT_TRUE(test_coupling(gappy, 3).empty());
}

TEST(Coupling, WhatDoesNotVaryHasNoAnswer) {
  EXPECT_TRUE(test_coupling(tests::Series(4096, 1.0), 3).empty());
  EXPECT_TRUE(test_coupling(tests::Series(4096, std::nan("")), 3).empty());
  EXPECT_TRUE(test_coupling({}, 3).empty());
}

}  // namespace
}  // namespace loopscope::core::model
