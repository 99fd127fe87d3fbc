#include "core/model/fit/noise_floor.hpp"

#include <gtest/gtest.h>

#include "tests/core/model/model_records.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::model {
namespace {

using loopscope::tests::kWindow;

struct Judged {
  double floor, error;
};

/// `pole`, `delay`, `noise`: of the fitted model; the truth is 0.8, 3 and AR(1) 0.9, w of
/// variance 1.
Judged judged(double pole, std::size_t delay, double noise_pole, std::uint64_t seed) {
  const tests::Series op = tests::stepping_op(kWindow, seed);
  const NoiseModel truth{1, {0.9, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  const tests::Series pv = tests::process_record(
      tests::one_lag(0.8, 3), 1.5, op, tests::coloured_noise(truth, kWindow, seed + 1, 1.0));
  const LoopData data = make_loop_data(pv, op, 1.0);
  Structure structure = tests::structure_of(tests::one_lag(pole, delay));
  structure.noise.poles[0] = noise_pole;
  const Fit fit = evaluate(data, structure);
  const double square = data.pv_scale * data.pv_scale;
  return {noise_floor(data, fit) * square, fit.score_error * square};
}

TEST(NoiseFloor, TheTruthIsAtTheFloor) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Judged truth = judged(0.8, 3, 0.9, seed);
    EXPECT_GT(truth.floor / truth.error, 0.97) << seed;
    EXPECT_LE(truth.floor, truth.error) << seed;
  }
}

/// What is left of the past in the innovations is no noise: the floor stays near that of the truth.
TEST(NoiseFloor, WrongLinearModelsHaveTheSameFloor) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const double truth = judged(0.8, 3, 0.9, seed).error;
    for (const Judged& wrong :
         {judged(0.8, 3, 0.5, seed), judged(0.8, 5, 0.9, seed), judged(0.6, 3, 0.9, seed)}) {
      EXPECT_LT(wrong.floor, 1.15 * truth) << seed;
      EXPECT_GT(wrong.floor, 0.9 * truth) << seed;
      EXPECT_LE(wrong.floor, wrong.error);
    }
  }
}

TEST(NoiseFloor, IsNeverAboveTheError) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    for (const double pole : {0.0, 0.5, 0.95}) {
      const Judged any = judged(pole, 1, pole, seed);
      EXPECT_LE(any.floor, any.error);
      EXPECT_GT(any.floor, 0.0);
    }
  }
}

}  // namespace
}  // namespace loopscope::core::model
