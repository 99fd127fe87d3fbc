#include <gtest/gtest.h>

#include "core/model/fit/batched/response_lanes-inl.hpp"
#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

/// That process, a little faster in every lane.
ProcessShape in_lane(ProcessShape shape, std::size_t lane) {
  const double share = 1.0 - 0.02 * static_cast<double>(lane);
  if (!shape.integrating) shape.pole *= share;
  shape.second_pole *= share;
  return shape;
}

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
  PoleLanes<NumberPair, 2> poles;
  for (std::size_t lane = 0; lane < 4; ++lane) poles.put(lane, in_lane(shape, lane));
  Lanes lanes(poles, noise, together[0]);
  lanes.run(together.data(), kCut);
  lanes.run(&together[kCut], kSamples - kCut);
  for (std::size_t lane = 0; lane < 4; ++lane) {
    tests::Series alone(kSamples);
    respond(in_lane(shape, lane), signals[lane], alone);
    whiten(noise, alone, alone);
    for (std::size_t k = 0; k < kSamples; ++k)
      EXPECT_NEAR(poles.gain[lane] * together[k][lane / 2][lane % 2], alone[k], 1e-10) << k;
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
