#include "core/model/response/noise_model.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

const NoiseModel kFirstOrder{1, {0.95, 0.0, 0.0}, {-0.3, 0.0, 0.0}};
/// Zeros 0.6 +- 0.4i.
const NoiseModel kSecondOrder{2, {0.95, 0.8, 0.0}, {-1.2, 0.52, 0.0}};
const NoiseModel kThirdOrder = extended(kSecondOrder, 0.7, 0.5);

std::vector<double> wave(double pace) {
  std::vector<double> v(103);
  for (std::size_t k = 0; k < v.size(); ++k) v[k] = 2.0 + std::sin(pace * static_cast<double>(k));
  return v;
}

class Noises : public testing::TestWithParam<NoiseModel> {};

TEST_P(Noises, WhiteningUndoesColouring) {
  const std::vector<double> coloured = tests::coloured_noise(GetParam(), 600, 5, 1.0);
  const std::vector<double> white = tests::white_noise(600, 5, 1.0);
  std::vector<double> w(coloured.size());
  whiten(GetParam(), coloured, w);
  // What the filter took for the past before the record is forgotten by then.
  for (std::size_t k = 200; k < w.size(); ++k) EXPECT_NEAR(w[k], white[k], 1e-6) << k;
}

TEST_P(Noises, OneSignalOrTwoAlike) {
  const std::vector<double> a = wave(0.3), b = wave(1.1);
  std::vector<double> one(a.size()), other(a.size()), first(a.size()), second(a.size());
  whiten(GetParam(), a, one);
  whiten(GetParam(), b, other);
  whiten(GetParam(), {a, b}, {first, second});
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_NEAR(first[k], one[k], 1e-12);
    EXPECT_NEAR(second[k], other[k], 1e-12);
  }
}

TEST_P(Noises, AConstantStaysOne) {
  std::vector<double> ones(20, 1.0);
  whiten(GetParam(), ones, ones);
  for (const double value : ones) EXPECT_NEAR(value, whitened_level(GetParam()), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Orders, Noises, testing::Values(kFirstOrder, kSecondOrder, kThirdOrder));

TEST(NoiseModel, ExtendedMultipliesTheZeroIn) {
  // (1 - 1.2 z + 0.52 z^2)(1 - 0.5 z)
  EXPECT_EQ(kThirdOrder.order, 3U);
  EXPECT_NEAR(kThirdOrder.zeros[0], -1.7, 1e-12);
  EXPECT_NEAR(kThirdOrder.zeros[1], 1.12, 1e-12);
  EXPECT_NEAR(kThirdOrder.zeros[2], -0.26, 1e-12);
  EXPECT_EQ(extended(kThirdOrder, 0.1, 0.1).order, 3U);
}

TEST(NoiseModel, ZerosOutsideAreDrawnIn) {
  NoiseModel noise{2, {0.9, 0.5, 0.0}, {-2.4, 1.44, 0.0}};  // twice 1.2
  make_invertible(noise);
  const double radius = std::sqrt(noise.zeros[1]);
  EXPECT_LT(radius, 0.985);
  EXPECT_GT(radius, 0.9);
  NoiseModel fine = kSecondOrder;
  make_invertible(fine);
  EXPECT_EQ(fine.zeros, kSecondOrder.zeros);
}

/// The answer to a single sample is rounding by then.
TEST(NoiseModel, WhiteningForgetsASample) {
  for (const NoiseModel& noise : {kFirstOrder, kSecondOrder, kThirdOrder}) {
    const std::size_t memory = whitening_memory(noise);
    std::vector<double> sample(memory + 100), answer(sample.size());
    sample[50] = 1.0;
    whiten(noise, sample, answer);
    for (std::size_t k = 50 + memory; k < answer.size(); ++k) EXPECT_LT(std::abs(answer[k]), 1e-15);
  }
  const NoiseModel slow{1, {1.0, 0.0, 0.0}, {-0.98, 0.0, 0.0}};
  EXPECT_EQ(whitening_memory(slow), std::numeric_limits<std::size_t>::max());
}

}  // namespace
}  // namespace loopscope::core::model
