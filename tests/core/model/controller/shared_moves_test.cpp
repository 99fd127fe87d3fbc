#include "core/model/controller/shared_moves.hpp"

#include <gtest/gtest.h>

#include "core/simulate/random.hpp"
#include "tests/core/model/known_loops.hpp"
#include "tests/core/model/model_records.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::model {
namespace {

TEST(SharedMoves, ACopyIsSharedWholly) {
  const known::Series noise = tests::white_noise(loopscope::tests::kWindow, 1);
  EXPECT_NEAR(find_shared_moves(noise, noise).r_squared, 1.0, 1e-9);
}

TEST(SharedMoves, IndependentNoiseSharesWhatThreeCoefficientsTake) {
  double sum = 0.0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const SharedMoves shared =
        find_shared_moves(tests::white_noise(loopscope::tests::kWindow, seed),
                          tests::white_noise(loopscope::tests::kWindow, seed + 1000));
    // Greatest of eight scales of chi-squared with three degrees of freedom: about 8.
    EXPECT_LT(shared.chi_squared, 45.0);
    sum += shared.chi_squared / 100.0;
  }
  EXPECT_LT(sum, 14.0);
}

TEST(SharedMoves, NothingComesOfNothing) {
  EXPECT_EQ(find_shared_moves({}, {}).scales, 0);
  const known::Series still(100, 1.0);
  EXPECT_EQ(find_shared_moves(still, still).r_squared, 0.0);
}

}  // namespace
}  // namespace loopscope::core::model
