#include "core/hos/linear/innovations.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "core/simulate/disturbances.hpp"
#include "core/simulate/missing_samples.hpp"
#include "tests/core/hos/signals.hpp"

namespace loopscope::core::hos {
namespace {

TEST(HosInnovations, AreThePartThatTheModelDoesNotPredict) {
  const auto record = tests::resonance(1);
  const auto found = Innovations::of(record);
  ASSERT_TRUE(found.has_value());
  const std::vector<double> errors = found->model().errors(record);
  for (std::size_t t = found->model().coefficients().size(); t < record.size(); ++t) {
    ASSERT_EQ(found->values()[t], errors[t]);
  }
}

TEST(HosInnovations, ScaleFollowsLoudness) {
  const auto record = simulate::with_level(tests::white_noise(2), 0.5, 1.0, 4.0);
  const auto found = Innovations::of(record);
  double before = 0.0;
  double after = 0.0;
  for (std::size_t t = 0; t < 2000; ++t) before += found->scale()[t] / 2000.0;
  for (std::size_t t = 2096; t < 4096; ++t) after += found->scale()[t] / 2000.0;
  // The prior's two samples have the whole record's mean square, 8.5.
  EXPECT_NEAR(before, std::sqrt((48.0 + 2.0 * 8.5) / 50.0), 0.06);
  EXPECT_NEAR(after, 4.0, 0.2);
}

TEST(HosInnovations, ScaleIsPositiveBesideGapsAndConstants) {
  auto record = simulate::with_gaps(tests::resonance(3), 0.4, 10, 3);
  for (std::size_t t = 3000; t < 3200; ++t) record[t] = 1.0;
  const auto found = Innovations::of(record);
  for (const double scale : found->scale()) ASSERT_GT(scale, 0.0);
}

/// <scale^4> / <scale^2>^2 of noise that is five times as loud for a tenth of the time is 5.5.
TEST(HosInnovations, ScatterSaysHowMuchLessIsKnown) {
  EXPECT_NEAR(Innovations::of(tests::white_noise(4))->scatter(), 1.05, 0.05);
  const auto loud = simulate::with_level(tests::white_noise(5), 0.4, 0.5, 5.0);
  EXPECT_NEAR(Innovations::of(loud)->scatter(), 5.5, 1.0);
}

/// The loudest fifth makes the model of the whole; weighted, the calm rest has its say.
TEST(HosInnovations, ReweightedTheyAreThoseOfTheCalmRecordToo) {
  auto record = tests::first_order_noise(6, 0.9);
  const auto loud = tests::first_order_noise(7, 0.3);
  for (std::size_t t = 0; t < 800; ++t) record[t] = 50.0 * loud[t];
  const auto found = Innovations::of(record, best_kernels(), {.largest = 1});
  const Innovations weighted = found->reweighted(record);
  ASSERT_EQ(weighted.model().coefficients().size(), 1U);
  EXPECT_LT(found->model().coefficients()[0], 0.4);
  EXPECT_GT(weighted.model().coefficients()[0], 0.5);
}

TEST(HosInnovations, NothingDrivesWhatIsPredictedExactly) {
  EXPECT_FALSE(Innovations::of(std::vector<double>(4096, 2.0)).has_value());
  EXPECT_FALSE(Innovations::of({}).has_value());
}

}  // namespace
}  // namespace loopscope::core::hos
