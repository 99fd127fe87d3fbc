#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "core/model/vectors/number_pair.hpp"
#include "core/model/vectors/recursion-inl.hpp"

namespace loopscope::core::model {
namespace {

double input(std::size_t k) {
  return std::sin(0.7 * static_cast<double>(k)) + (k == 5 ? 3.0 : 0.0);
}

std::vector<double> one_by_one(double root, double before, std::size_t count) {
  std::vector<double> y;
  for (std::size_t k = 0; k < count; ++k) y.push_back(before = root * before + input(k));
  return y;
}

TEST(Recursion, IsTheRecursionOfOneSampleAfterTheOther) {
  for (const double root : {0.0, -0.9, 0.5, 0.999, 1.0}) {
    for (const std::size_t count : {0U, 1U, 3U, 4U, 7U, 200U}) {
      std::vector<double> y(count);
      run_recursion(root, 0.3, count, input, [&](std::size_t k, double value) { y[k] = value; });
      const std::vector<double> expected = one_by_one(root, 0.3, count);
      for (std::size_t k = 0; k < count; ++k) EXPECT_NEAR(y[k], expected[k], 1e-12);
    }
  }
}

TEST(Recursion, RunsTwoSideBySide) {
  constexpr std::size_t kCount = 50;
  std::vector<NumberPair> y(kCount);
  run_recursion(
      NumberPair{0.8, -0.2}, NumberPair{0.0, 1.0}, kCount,
      [](std::size_t k) { return NumberPair{} + input(k); },
      [&](std::size_t k, NumberPair value) { y[k] = value; });
  const std::vector<double> a = one_by_one(0.8, 0.0, kCount);
  const std::vector<double> b = one_by_one(-0.2, 1.0, kCount);
  for (std::size_t k = 0; k < kCount; ++k) {
    EXPECT_NEAR(y[k][0], a[k], 1e-12);
    EXPECT_NEAR(y[k][1], b[k], 1e-12);
  }
}

}  // namespace
}  // namespace loopscope::core::model
