#include "core/model/noise_model.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace loopscope::core::model {
namespace {

constexpr NoiseModel kNoise{{0.95, 0.4}, {0.3, -0.2}};

std::vector<double> signal(double pace) {
  std::vector<double> v(103);
  for (std::size_t k = 0; k < v.size(); ++k) v[k] = 2.0 + std::sin(pace * static_cast<double>(k));
  return v;
}

/// Sample by sample, from rest at the first value.
std::vector<double> expected(std::vector<double> v) {
  for (std::size_t pair = 0; pair < 2; ++pair) {
    const double pole = kNoise.poles[pair];
    const double zero = kNoise.zeros[pair];
    double before = v[0];
    double state = v[0] * (1.0 - pole) / (1.0 - zero);
    for (double& value : v) {
      state = value - pole * before + zero * state;
      before = value;
      value = state;
    }
  }
  return v;
}

TEST(NoiseModel, WhitensOneSignalTwoOrATableAlike) {
  const std::vector<double> a = signal(0.3);
  const std::vector<double> b = signal(1.1);
  std::vector<double> one(a.size()), first(a.size()), second(a.size()), table(4 * a.size(), 0.0);
  for (std::size_t k = 0; k < a.size(); ++k) table[4 * k + 2] = a[k];
  whiten(kNoise, a, one);
  whiten(kNoise, {a, b}, {first, second});
  whiten(kNoise, table, 4);
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_NEAR(one[k], expected(a)[k], 1e-12);
    EXPECT_NEAR(first[k], expected(a)[k], 1e-12);
    EXPECT_NEAR(second[k], expected(b)[k], 1e-12);
    EXPECT_NEAR(table[4 * k + 2], expected(a)[k], 1e-12);
  }
}

TEST(NoiseModel, AConstantStaysOne) {
  std::vector<double> ones(20, 1.0);
  whiten(kNoise, ones, ones);
  for (const double value : ones) EXPECT_NEAR(value, whitened_level(kNoise), 1e-14);
  EXPECT_EQ(whitened_level({{0.5, 0.2}, {0.5, 0.2}}), 1.0);
}

}  // namespace
}  // namespace loopscope::core::model
