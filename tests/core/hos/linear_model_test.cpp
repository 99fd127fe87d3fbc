#include "core/hos/linear_model.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "core/simulate/coloured_noise.hpp"
#include "core/simulate/missing_samples.hpp"
#include "tests/core/hos/signals.hpp"

namespace loopscope::core::hos {
namespace {

using simulate::Innovation;

/// Mean of x(t) x(t + lag) over pairs that are both there.
double covariance(const std::vector<double>& x, std::size_t lag) {
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t t = 0; t + lag < x.size(); ++t) {
    if (std::isfinite(x[t]) && std::isfinite(x[t + lag])) {
      sum += x[t] * x[t + lag];
      count += 1.0;
    }
  }
  return sum / count;
}

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
    std::mt19937_64 random(1);
    for (const double value : model->draw(record, random)) ASSERT_TRUE(std::abs(value) < 1e4);
  }
}

TEST(HosLinearModel, DrawsRecordsOfTheSameSpectrum) {
  const auto record = tests::resonance(5, 16'384);
  const auto model = LinearModel::fit(record);
  std::mt19937_64 random(2);
  const auto drawn = model->draw(record, random);
  const double variance = covariance(record, 0);
  EXPECT_NEAR(covariance(drawn, 0) / variance, 1.0, 0.15);
  for (const std::size_t lag : {1U, 5U, 10U, 20U}) {
    EXPECT_NEAR(covariance(drawn, lag) / covariance(drawn, 0), covariance(record, lag) / variance,
                0.06)
        << lag;
  }
}

TEST(HosLinearModel, DrawsAreMissingWhereTheRecordIs) {
  auto record = simulate::with_gaps(tests::resonance(6), 0.3, 5, 1);
  record[7] = std::numeric_limits<double>::infinity();
  const auto model = LinearModel::fit(record);
  std::mt19937_64 random(3);
  const auto drawn = model->draw(record, random);
  ASSERT_EQ(drawn.size(), record.size());
  for (std::size_t t = 0; t < record.size(); ++t) {
    ASSERT_EQ(std::isfinite(drawn[t]), std::isfinite(record[t])) << t;
  }
}

TEST(HosLinearModel, KeepsTheNoiseOfTheRecord) {
  const auto skewed =
      simulate::coloured_noise(simulate::real_pole(0.9), Innovation::exponential, 4096, 7);
  EXPECT_EQ(LinearModel::fit(skewed)->noise().core(), ResidualNoise::Core::other);
  EXPECT_EQ(LinearModel::fit(tests::resonance(8))->noise().core(), ResidualNoise::Core::gaussian);
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
