#include "core/model/answer_lanes.hpp"

#include <gtest/gtest.h>

#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

/// Process and whitening of four signals in two stretches against those of each by itself.
void expect_respond_and_whiten(const ProcessShape& shape, const NoiseModel& noise) {
  using Lanes = AnswerLanes<NumberPair, 2>;
  constexpr std::size_t kSamples = 300, kCut = 117;
  std::vector<tests::Series> signals;
  std::vector<Lanes::Numbers> together(kSamples);
  for (std::size_t lane = 0; lane < 4; ++lane) {
    signals.push_back(tests::white_noise(kSamples, lane + 1));
    const std::size_t delay = shape.delay_samples;
    for (std::size_t k = 0; k < kSamples; ++k)
      together[k][lane / 2][lane % 2] = signals[lane][k < delay ? 0 : k - delay];
  }
  Lanes lanes(shape, noise, together[0]);
  lanes.run(together.data(), kCut);
  lanes.run(&together[kCut], kSamples - kCut);
  for (std::size_t lane = 0; lane < 4; ++lane) {
    tests::Series alone(kSamples);
    respond(shape, signals[lane], alone);
    whiten(noise, alone, alone);
    for (std::size_t k = 0; k < kSamples; ++k)
      EXPECT_NEAR(together[k][lane / 2][lane % 2], alone[k], 1e-10) << k;
  }
}

TEST(AnswerLanes, AreProcessAndWhiteningOfEachSignal) {
  for (const ProcessShape& shape : {tests::one_lag(0.0, 1), tests::one_lag(0.97, 4),
                                    tests::two_lags(0.9, 0.6, 2), tests::integrator(3)}) {
    expect_respond_and_whiten(shape, {1, {0.95, 0.0, 0.0}, {-0.4, 0.0, 0.0}});
    expect_respond_and_whiten(shape, {2, {1.0, 0.5, 0.0}, {-0.9, 0.3, 0.0}});
    expect_respond_and_whiten(shape, {3, {1.0, 0.6, -0.2}, {-0.5, 0.1, -0.05}});
  }
}

TEST(AnswerLanes, AnIntegratorBehindALagToo) {
  ProcessShape shape = tests::integrator(2);
  shape.second_pole = 0.8;
  expect_respond_and_whiten(shape, {3, {1.0, 0.6, 0.2}, {-0.5, 0.1, -0.05}});
}

}  // namespace
}  // namespace loopscope::core::model
