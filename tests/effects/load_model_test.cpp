#include "tests/effects/load_model.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/effects/scenario.hpp"

namespace loopscope::tests::effects {
namespace {

TEST(Predictor, OfWhiteNoiseLeavesAllOfIt) {
  EXPECT_NEAR(predictor(LoadModel{}, 2.5, 1).variance, 2.5, 1e-12);
}

TEST(Predictor, OfARandomWalkInNoiseHasTheClosedForm) {
  const double walk = 0.3;
  const double noise = 2.0;
  LoadModel load = output_load_model(1.0);
  load.scale = std::sqrt(walk);
  const double foreseen = walk / 2.0 + std::sqrt(walk * walk / 4.0 + walk * noise);
  EXPECT_NEAR(predictor(load, noise, 1).variance, foreseen + noise, 1e-6);
}

TEST(Predictor, OfAHeldRandomWalkSeesTheWholeStretch) {
  LoadModel load = output_load_model(1.0);
  EXPECT_NEAR(predictor(load, 0.0, 7).variance, 7.0, 1e-9);
}

TEST(Predictor, LeavesAnAutoregressionItsInnovations) {
  const double memory = 0.95;
  const LoadModel load = output_load_model(memory);
  // Sum of memory^(2 i / substeps) / substeps over the substeps of a sample.
  const double fine = std::pow(memory, 2.0 / kSubsteps);
  const double added = (1.0 - memory * memory) / (1.0 - fine) / kSubsteps;
  EXPECT_NEAR(predictor(load, 0.0, 1).variance, added, 1e-9);
}

TEST(LoadModel, ALoadThatReturnsForgetsInTime) {
  LoadModel integrated = output_load_model(1.0), short_lived = output_load_model(0.9);
  integrated.return_within(500.0);
  short_lived.return_within(500.0);
  EXPECT_NEAR(std::pow(integrated.transition(0, 0), 500 * kSubsteps), std::exp(-1.0), 1e-9);
  EXPECT_EQ(short_lived.transition, output_load_model(0.9).transition);
}

/// A load at the input is what the process makes of it: checked against the process itself.
void expect_same_path(const Process& process) {
  Scenario open_loop;
  open_loop.process = process;
  open_loop.controller.kc = 0.0;
  open_loop.sp.assign(kRunIn + kSamples, 0.0);
  open_loop.input_load = [](double time) { return time >= 0.0 ? 1.0 : 0.0; };
  const Series series = simulate(open_loop);
  const LoadModel load =
      input_load_model(1.0, {process.integrating, process.gain, process.tau, process.second_tau});
  Eigen::Vector3d state(1.0, 0.0, 0.0);
  for (std::size_t k = 0; k < 200; ++k) {
    // The discrete second lag sees the first one at the substep's end or start: within a substep.
    ASSERT_NEAR(load.value(state), series.pv[k], 0.02 * std::abs(process.gain)) << k;
    for (int i = 0; i < kSubsteps; ++i) state = (load.transition * state).eval();
  }
}

TEST(LoadModel, AtTheInputPassesTheLagsOfTheProcess) {
  expect_same_path({.gain = -2.0, .tau = 8.0});
  expect_same_path({.gain = 1.5, .tau = 20.0, .second_tau = 5.0});
  expect_same_path({.integrating = true, .gain = 0.5, .tau = 50.0, .second_tau = 3.0});
}

}  // namespace
}  // namespace loopscope::tests::effects
