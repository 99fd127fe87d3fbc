#include "core/model/controller/sampled_process.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <stdexcept>

namespace loopscope::core::model {
namespace {

/// TestOutcome to a unit step of op after `samples`.
double step_answer(const SampledProcess& process, std::size_t samples) {
  Polynomial y;
  for (std::size_t k = 0; k <= samples; ++k) {
    double value = 0.0;
    for (std::size_t j = 1; j < process.denominator.size() && j <= k; ++j) {
      value -= process.denominator[j] * y[k - j];
    }
    for (std::size_t j = 0; j < process.numerator.size(); ++j) {
      if (k >= process.delay_samples + j) value += process.numerator[j];
    }
    y.push_back(value);
  }
  return y.back();
}

TEST(SampledProcess, FirstOrderIsTheExactHold) {
  const SampledProcess p = sample_process({false, 2.0, 10.0, 0.0, 3.0}, 1.0);
  EXPECT_EQ(p.delay_samples, 3U);
  // One interval of the delay is the hold's: after 8 samples the lag has run for 6.
  EXPECT_NEAR(step_answer(p, 8), 2.0 * (1.0 - std::exp(-0.6)), 1e-12);
}

TEST(SampledProcess, SecondOrderIsTheExactHold) {
  const SampledProcess p = sample_process({false, 1.5, 8.0, 3.0, 1.0}, 0.5);
  const double t = 20 * 0.5 - 1.0 + 0.5;
  const double exact = 1.5 * (1.0 - (8.0 * std::exp(-t / 8.0) - 3.0 * std::exp(-t / 3.0)) / 5.0);
  EXPECT_NEAR(step_answer(p, 20), exact, 1e-12);
}

TEST(SampledProcess, EqualLagsAreTheLimit) {
  const SampledProcess p = sample_process({false, 1.0, 5.0, 5.0, 1.0}, 1.0);
  EXPECT_NEAR(step_answer(p, 7), 1.0 - (1.0 + 7.0 / 5.0) * std::exp(-7.0 / 5.0), 1e-3);
}

TEST(SampledProcess, IntegratorsRamp) {
  EXPECT_NEAR(step_answer(sample_process({true, 0.02, 0.0, 0.0, 2.0}, 1.0), 11), 0.2, 1e-12);
  const SampledProcess lagged = sample_process({true, 0.02, 4.0, 0.0, 1.0}, 1.0);
  EXPECT_NEAR(step_answer(lagged, 9), 0.02 * (9.0 - 4.0 * (1.0 - std::exp(-9.0 / 4.0))), 1e-12);
}

TEST(SampledProcess, ResponseAtZeroIsTheGain) {
  const SampledProcess p = sample_process({false, -3.0, 20.0, 6.0, 4.0}, 2.0);
  EXPECT_NEAR(response(p, 1e-9).real(), -3.0, 1e-6);
}

TEST(SampledProcess, OddFitsAreTheCallersError) {
  EXPECT_THROW((void)sample_process({}, 0.0), std::invalid_argument);
  EXPECT_THROW((void)sample_process({false, NAN, 1.0, 0.0, 1.0}, 1.0), std::invalid_argument);
}

}  // namespace
}  // namespace loopscope::core::model
