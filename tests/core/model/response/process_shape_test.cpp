#include "core/model/response/process_shape.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

tests::Series step_at(std::size_t at, std::size_t samples) {
  tests::Series input(samples, 0.0);
  for (std::size_t k = at; k < samples; ++k) input[k] = 1.0;
  return input;
}

TEST(ProcessShape, ADelayIsAShiftOfTheFirstValue) {
  const tests::Series input = tests::white_noise(100, 1);
  for (const std::size_t delay : {0U, 1U, 7U, 99U, 100U, 200U}) {
    tests::Series response(100);
    respond(tests::one_lag(0.0, delay), input, response);
    for (std::size_t k = 0; k < 100; ++k) {
      EXPECT_EQ(response[k], input[k < delay ? 0 : k - delay]) << delay;
    }
  }
}

TEST(ProcessShape, AStepEndsAtGainOne) {
  const tests::Series input = step_at(5, 3000);
  for (const double pole : {0.0, 0.5, 0.9, 0.99}) {
    for (const double second : {0.0, 0.8}) {
      EXPECT_NEAR(answer(tests::two_lags(pole, second, 3), input).back(), 1.0, 1e-9);
    }
  }
}

TEST(ProcessShape, OneLagAnswersExponentially) {
  const tests::Series response = answer(tests::one_lag(0.8, 2), step_at(10, 100));
  for (std::size_t k = 12; k < 100; ++k) {
    EXPECT_NEAR(response[k], 1.0 - std::pow(0.8, static_cast<double>(k - 11)), 1e-12);
  }
}

TEST(ProcessShape, BeforeTheRecordTheInputWasAtItsFirstValue) {
  const tests::Series constant(50, 7.0);
  for (const double value : answer(tests::two_lags(0.9, 0.5, 4), constant)) {
    EXPECT_NEAR(value, 7.0, 1e-12);
  }
}

TEST(ProcessShape, AnIntegratorSumsItsInput) {
  const tests::Series input = tests::white_noise(200, 3);
  tests::Series response(200);
  respond(tests::integrator(4), input, response);
  for (std::size_t k = 5; k < 200; ++k) {
    EXPECT_NEAR(response[k] - response[k - 1], input[k - 4], 1e-12);
  }
}

TEST(ProcessShape, TheNumeratorWeighsThisAndTheLastSample) {
  ProcessShape shape = tests::one_lag(0.7, 1);
  const tests::Series input = tests::white_noise(200, 3);
  tests::Series response(200);
  respond(shape, input, response);
  shape.numerator = {1.6, -0.6};
  const tests::Series result = answer(shape, input);
  for (std::size_t k = 1; k < 200; ++k) {
    EXPECT_NEAR(result[k], 1.6 * response[k] - 0.6 * response[k - 1], 1e-12);
  }
}

/// Eq. 20 of the paper is of this form: gain 2.25, numerator (1.45, -1) / 0.45.
TEST(ProcessShape, HoldsTheProcessOfThePaper) {
  ProcessShape shape = tests::one_lag(0.8, 3);
  shape.numerator = {1.45 / 0.45, -1.0 / 0.45};
  const tests::Series response = tests::scaled(answer(shape, step_at(10, 200)), 2.25);
  tests::Series expected(200, 0.0);
  for (std::size_t k = 13; k < 200; ++k) {
    expected[k] = 0.8 * expected[k - 1] + 1.45 - (k >= 14 ? 1.0 : 0.0);
    EXPECT_NEAR(response[k], expected[k], 1e-9);
  }
}

TEST(ProcessShape, LagsCommute) {
  tests::Series one = tests::white_noise(300, 5), other = one;
  one.front() = other.front() = 0.0;
  lag(0.9, one);
  lag(0.4, one);
  lag(0.4, other);
  lag(0.9, other);
  for (std::size_t k = 0; k < 300; ++k) EXPECT_NEAR(one[k], other[k], 1e-12);
}

TEST(ProcessShape, NothingIsAnsweredByNothing) {
  EXPECT_TRUE(answer(tests::one_lag(0.5, 2), {}).empty());
}

}  // namespace
}  // namespace loopscope::core::model
