#include "core/model/noise_model.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <stdexcept>

#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

tests::Series whitened(const NoiseModel& noise, const tests::Series& signal,
                       std::size_t width = 4) {
  tests::Series table(signal.size() * width, 0.0);
  for (std::size_t k = 0; k < signal.size(); ++k) table[width * k + width - 1] = signal[k];
  whiten(noise, table, width);
  tests::Series result(signal.size());
  for (std::size_t k = 0; k < signal.size(); ++k) result[k] = table[width * k + width - 1];
  return result;
}

const NoiseModel kModels[] = {{{0.95, 0.0}, {0.5, 0.0}},
                              {{1.0, 0.0}, {0.0, 0.0}},
                              {{1.0, 0.7}, {0.9, -0.3}},
                              {{-0.5, 0.2}, {0.8, 0.1}}};

TEST(NoiseModel, WhitenIsTheInverseOfTheFilter) {
  for (const NoiseModel& noise : kModels) {
    tests::Series white = tests::white_noise(2000, 4);
    const tests::Series back = whitened(noise, tests::coloured_noise(noise, 2000, 4, 1.0));
    // What the filters remember of the start has gone by then: 0.9^300.
    for (std::size_t k = 300; k < 2000; ++k) EXPECT_NEAR(back[k], white[k], 1e-8);
  }
}

TEST(NoiseModel, AConstantIsAtRestFromTheFirstSample) {
  for (const NoiseModel& noise : kModels) {
    double rest = 3.0;
    for (std::size_t i = 0; i < 2; ++i) rest *= (1.0 - noise.poles[i]) / (1.0 - noise.zeros[i]);
    for (const double value : whitened(noise, tests::Series(50, 3.0)))
      EXPECT_NEAR(value, rest, 1e-9);
  }
}

TEST(NoiseModel, EqualRootsAreWhiteNoise) {
  const tests::Series signal = tests::white_noise(200, 1);
  const tests::Series same = whitened({{0.7, 0.3}, {0.7, 0.3}}, signal);
  for (std::size_t k = 0; k < 200; ++k) EXPECT_NEAR(same[k], signal[k], 1e-12);
}

TEST(NoiseModel, EveryWidthGivesTheSame) {
  const tests::Series signal = tests::white_noise(200, 1);
  const tests::Series narrow = whitened(kModels[2], signal, 4);
  for (std::size_t width = 8; width <= kMaxColumns; width += 4) {
    EXPECT_EQ(whitened(kModels[2], signal, width), narrow) << width;
  }
}

TEST(NoiseModel, IsLinear) {
  const tests::Series a = tests::white_noise(200, 1), b = tests::stepping_op(200, 2);
  const tests::Series joint = whitened(kModels[0], tests::sum(a, tests::scaled(b, 2.0)));
  const tests::Series apart =
      tests::sum(whitened(kModels[0], a), tests::scaled(whitened(kModels[0], b), 2.0));
  for (std::size_t k = 0; k < 200; ++k) EXPECT_NEAR(joint[k], apart[k], 1e-9);
}

TEST(NoiseModel, OtherWidthsAreRefused) {
  tests::Series table(30, 0.0);
  EXPECT_THROW(whiten(kModels[0], table, 3), std::invalid_argument);
}

}  // namespace
}  // namespace loopscope::core::model
