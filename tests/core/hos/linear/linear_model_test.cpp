#include "core/hos/linear/linear_model.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "core/simulate/coloured_noise.hpp"
#include "core/simulate/missing_samples.hpp"
#include "tests/core/hos/signals.hpp"

namespace loopscope::core::hos {
namespace {

void expect_resonance(const LinearModel& model) {
  ASSERT_GE(model.coefficients().size(), 2U);
  const simulate::AllPole truth = simulate::resonance(20.0, 0.95);
  // Orders above two wander by 1 / sqrt(4096) each.
  EXPECT_NEAR(model.coefficients()[0], truth.a1, 0.1);
  EXPECT_NEAR(model.coefficients()[1], truth.a2, 0.17);
}

TEST(HosLinearModel, RecoversAResonance) {
  std::size_t orders = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto model = LinearModel::fit(tests::affine(tests::resonance(seed), 3.0, 50.0));
    ASSERT_TRUE(model.has_value());
    expect_resonance(*model);
    orders += model->coefficients().size();
  }
  EXPECT_LE(orders, 20U * 8U);
}

TEST(HosLinearModel, AGapAddsNothing) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto signal = simulate::with_gaps(tests::resonance(seed), 0.4, 10, seed);
    const auto model = LinearModel::fit(signal);
    ASSERT_TRUE(model.has_value());
    expect_resonance(*model);
  }
}

TEST(HosLinearModel, WhiteNoiseHasNoMemory) {
  int without = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    without += LinearModel::fit(tests::white_noise(seed))->coefficients().empty() ? 1 : 0;
  }
  EXPECT_GE(without, 20);
}

TEST(HosLinearModel, IsStableOnARandomWalkAndOnLines) {
  std::vector<std::vector<double>> records = {tests::first_order_noise(3, 1.0),
                                              tests::sinusoid_in_noise(4, 20.0)};
  records.emplace_back(4096);
  for (std::size_t n = 0; n < 4096; ++n) records.back()[n] = n % 16 < 8 ? 1.0 : -1.0;
  for (const auto& record : records) {
    const auto model = LinearModel::fit(record);
    ASSERT_TRUE(model.has_value());
    const std::vector<double> errors = model->errors(record);
    const LinearModel again = model->reweighted(record, errors, std::vector(record.size(), 1.0));
    for (const LinearModel& one : {*model, again}) {
      std::vector<double> free(20'000);
      std::copy_n(record.begin(), one.coefficients().size(), free.begin());
      one.drive(free);
      for (const double value : free) ASSERT_TRUE(std::abs(value) < 1e4);
    }
  }
}

TEST(HosLinearModel, DrivenByItsErrorsItGivesTheRecordBack) {
  const auto record = tests::affine(tests::resonance(6), 1.0, 7.0);
  const auto model = LinearModel::fit(record);
  ASSERT_TRUE(model.has_value());
  std::vector<double> driven = model->errors(record);
  const std::size_t order = model->coefficients().size();
  for (std::size_t t = 0; t < order; ++t) {
    EXPECT_TRUE(std::isnan(driven[t]));
    driven[t] = record[t] - model->mean();
  }
  model->drive(driven);
  for (std::size_t t = 0; t < record.size(); ++t) {
    ASSERT_NEAR(driven[t] + model->mean(), record[t], 1e-9);
  }
}

TEST(HosLinearModel, ErrorsAreUnknownBehindAGap) {
  auto record = tests::resonance(7);
  record[1000] = std::numeric_limits<double>::infinity();
  const auto model = LinearModel::fit(record);
  const std::size_t order = model->coefficients().size();
  const std::vector<double> errors = model->errors(record);
  for (std::size_t t = order; t < record.size(); ++t) {
    ASSERT_EQ(std::isfinite(errors[t]), t < 1000 || t > 1000 + order) << t;
  }
}

/// Where the loud half of a record follows another model than the calm one, weights of the inverse
/// scale give the calm one the same say.
TEST(HosLinearModel, WeightsDecideWhichPartIsFitted) {
  auto record = tests::first_order_noise(8, 0.9);
  const auto other = tests::first_order_noise(9, 0.2);
  for (std::size_t t = 2048; t < record.size(); ++t) record[t] = 30.0 * other[t];
  const auto model = LinearModel::fit(record, best_kernels(), {.largest = 1});
  ASSERT_EQ(model->coefficients().size(), 1U);
  EXPECT_NEAR(model->coefficients()[0], 0.2, 0.05);
  std::vector<double> scale(record.size(), 1.0);
  std::fill(scale.begin() + 2048, scale.end(), 1e6);
  const LinearModel calm = model->reweighted(record, model->errors(record), scale);
  EXPECT_NEAR(calm.coefficients()[0], 0.9, 0.05);
}

TEST(HosLinearModel, APenaltyMakesItShorter) {
  const auto record = tests::resonance(5);
  const auto usual = LinearModel::fit(record);
  const auto shorter = LinearModel::fit(record, best_kernels(), {.penalty = 20.0});
  EXPECT_EQ(shorter->coefficients().size(), 2U);
  EXPECT_LE(shorter->coefficients().size(), usual->coefficients().size());
}

TEST(HosLinearModel, NeedsVarianceAndSamplesThatFollowEachOther) {
  EXPECT_FALSE(LinearModel::fit({}).has_value());
  EXPECT_FALSE(LinearModel::fit(std::vector<double>(4096, 0.1)).has_value());
  EXPECT_FALSE(LinearModel::fit(std::vector<double>(4096, std::nan(""))).has_value());
  EXPECT_FALSE(LinearModel::fit(tests::white_noise(1, 99)).has_value());
  EXPECT_TRUE(LinearModel::fit(tests::white_noise(1, 200)).has_value());
  auto torn = tests::resonance(9);
  for (std::size_t n = 0; n < torn.size(); n += 3) torn[n] = std::nan("");
  EXPECT_NO_THROW((void)LinearModel::fit(torn));
}

}  // namespace
}  // namespace loopscope::core::hos
