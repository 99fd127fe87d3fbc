#include "core/signal/read_back.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "core/signal/loop_window.hpp"
#include "core/simulate/random.hpp"

namespace loopscope::core::signal {
namespace {

constexpr int kReadings = 400;
constexpr std::size_t kReadingSamples = 2048;

/// `gain`: of the error in an output that is read in steps of 0.1 beside noise of 0.05.
struct Reading {
  Samples op, error;
  Reading(double gain, std::size_t delay, std::uint64_t seed) {
    simulate::GaussianSource gauss(seed);
    for (std::size_t k = 0; k < kReadingSamples; ++k) {
      error.push_back(k == 0 ? 0.0 : 0.7 * error.back() + gauss.next());
      const double answered = k < delay ? 0.0 : error[k - delay];
      op.push_back(0.1 * std::round(10.0 * (43.0 + gain * answered + 0.05 * gauss.next())));
    }
  }
};

int taken_for_read_back(double gain, std::size_t delay) {
  int taken = 0;
  for (int record = 0; record < kReadings; ++record) {
    const Reading reading(gain, delay, 7000 + static_cast<std::uint64_t>(record));
    taken += is_read_back_noise(reading.op, reading.error) ? 1 : 0;
  }
  return taken;
}

TEST(ReadBack, AnOutputThatNobodyMovesIsInNearlyAllRecords) {
  EXPECT_GE(taken_for_read_back(0.0, 0), kReadings - 2);
}

TEST(ReadBack, OneThatAnswersTheErrorIsNever) {
  for (const std::size_t delay : {0U, 1U, 3U}) EXPECT_EQ(taken_for_read_back(0.05, delay), 0);
}

TEST(ReadBack, OneWithACourseOrWithoutMovesOrErrorIsNot) {
  Reading reading(0.0, 0, 1);
  Samples drifting = reading.op;
  for (std::size_t k = 0; k < kReadingSamples; ++k) drifting[k] += 0.001 * static_cast<double>(k);
  EXPECT_FALSE(is_read_back_noise(drifting, reading.error));
  EXPECT_FALSE(is_read_back_noise(Samples(kReadingSamples, 43.0), reading.error));
  EXPECT_FALSE(is_read_back_noise(reading.op, Samples(kReadingSamples, 0.0)));
  EXPECT_FALSE(is_read_back_noise(Samples(kReadingSamples, kMissing), reading.error));
  EXPECT_FALSE(is_read_back_noise({}, {}));
}

}  // namespace
}  // namespace loopscope::core::signal
