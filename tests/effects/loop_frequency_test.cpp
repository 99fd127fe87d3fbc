#include "tests/effects/loop_frequency.hpp"

#include <cmath>
#include <complex>
#include <gtest/gtest.h>

#include "tests/effects/draft.hpp"
#include "tests/generators/values.hpp"

namespace loopscope::tests::effects {
namespace {

TEST(LoopFrequency, OfAFirstOrderLagIsTheSampledLag) {
  const LoopFrequency loop({.gain = 2.0, .tau = 5.0, .delay = 3.0});
  const double pole = std::exp(-1.0 / 5.0);
  for (const double frequency : {0.01, 0.3, 2.0}) {
    const std::complex<double> back = std::polar(1.0, -frequency);
    EXPECT_NEAR(loop.process_gain(frequency),
                std::abs(2.0 * (1.0 - pole) * back / (1.0 - pole * back)), 1e-4);
  }
}

/// How much an upset of the linear loop grows from the second to the last quarter of a record.
double growth(const Process& process, Controller controller) {
  Scenario scenario;
  scenario.process = process;
  scenario.controller = controller;
  scenario.sp.assign(kRunIn + kSamples, 0.0);
  scenario.output_load = [](double time) { return time < 0.0 ? 1e-9 : 0.0; };
  const std::vector<double> pv = simulate(scenario).pv;
  const auto part = static_cast<std::ptrdiff_t>(pv.size() / 4);
  return generators::standard_deviation({pv.end() - part, pv.end()}) /
         generators::standard_deviation({pv.begin() + part / 4, pv.begin() + part});
}

void expect_edge_of_stability(const Process& process, Controller controller) {
  controller.kc *= LoopFrequency(process).gain_margin(controller);
  Controller beyond = controller;
  controller.kc *= 0.98;
  beyond.kc *= 1.02;
  EXPECT_LT(growth(process, controller), 1.0);
  EXPECT_GT(growth(process, beyond), 1.0);
}

TEST(LoopFrequency, GainMarginIsWhereTheSimulatedLoopStartsToSwing) {
  expect_edge_of_stability({.gain = 1.5, .tau = 12.0, .delay = 3.4}, {0.5, 12.0});
  expect_edge_of_stability({.gain = -0.7, .tau = 6.0, .second_tau = 3.0, .delay = 5.7},
                           {-0.5, 8.0});
  expect_edge_of_stability({.integrating = true, .gain = 1.0, .tau = 40.0, .delay = 2.3},
                           {2.0, 60.0});
}

}  // namespace
}  // namespace loopscope::tests::effects
