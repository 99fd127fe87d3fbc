#include "core/hos/surrogates/surrogates.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "core/simulate/missing_samples.hpp"
#include "tests/core/hos/signals.hpp"

namespace loopscope::core::hos {
namespace {

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

/// The innovations of a surrogate under the model that it was driven through.
std::vector<double> innovations_of(const std::vector<double>& record, Null null,
                                   std::uint64_t seed) {
  const auto innovations = Innovations::of(record);
  Surrogates surrogates(record, *innovations, null, seed);
  std::vector<double> drawn;
  surrogates.draw(drawn);
  for (double& value : drawn) value += innovations->model().mean();
  return innovations->model().errors(drawn);
}

TEST(HosSurrogates, SignsKeepEveryMagnitudeInItsPlace) {
  const auto record = tests::affine(tests::resonance(1), 2.0, 9.0);
  const auto innovations = Innovations::of(record);
  const auto drawn = innovations_of(record, Null::random_signs, 2);
  int flipped = 0;
  for (std::size_t t = innovations->model().coefficients().size(); t < record.size(); ++t) {
    ASSERT_NEAR(std::abs(drawn[t]), std::abs(innovations->values()[t]), 1e-8);
    flipped += drawn[t] * innovations->values()[t] < 0.0 ? 1 : 0;
  }
  EXPECT_NEAR(flipped, 2048, 4 * 32);
}

TEST(HosSurrogates, PermutedKeepsEveryValueButNoPlace) {
  const auto record = tests::coloured(simulate::Innovation::exponential, 0.8, 1);
  const auto innovations = Innovations::of(record);
  auto drawn = innovations_of(record, Null::permuted, 2);
  const auto order = static_cast<std::ptrdiff_t>(innovations->model().coefficients().size());
  std::vector<double> before(innovations->values().begin() + order, innovations->values().end());
  drawn.erase(drawn.begin(), drawn.begin() + order);
  EXPECT_GT(std::abs(drawn[100] - before[100]) + std::abs(drawn[200] - before[200]), 1e-6);
  std::ranges::sort(before);
  std::ranges::sort(drawn);
  for (std::size_t i = 0; i < before.size(); ++i) ASSERT_NEAR(drawn[i], before[i], 1e-8);
}

TEST(HosSurrogates, HaveTheRecordsSpectrum) {
  const auto record = tests::resonance(5, 16'384);
  const auto innovations = Innovations::of(record);
  for (const Null null : {Null::random_signs, Null::permuted}) {
    Surrogates surrogates(record, *innovations, null, 3);
    std::vector<double> drawn;
    surrogates.draw(drawn);
    const double variance = covariance(record, 0);
    EXPECT_NEAR(covariance(drawn, 0) / variance, 1.0, 0.15);
    for (const std::size_t lag : {1U, 5U, 10U, 20U}) {
      EXPECT_NEAR(covariance(drawn, lag) / covariance(drawn, 0), covariance(record, lag) / variance,
                  0.06)
          << lag;
    }
  }
}

TEST(HosSurrogates, AreMissingWhereTheRecordIs) {
  auto record = simulate::with_gaps(tests::resonance(6), 0.3, 5, 1);
  record[7] = std::numeric_limits<double>::infinity();
  const auto innovations = Innovations::of(record);
  for (const Null null : {Null::random_signs, Null::permuted}) {
    Surrogates surrogates(record, *innovations, null, 3);
    std::vector<double> drawn(3);
    surrogates.draw(drawn);
    ASSERT_EQ(drawn.size(), record.size());
    for (std::size_t t = 0; t < record.size(); ++t) {
      ASSERT_EQ(std::isfinite(drawn[t]), std::isfinite(record[t])) << t;
    }
  }
}

TEST(HosSurrogates, TheSameSeedDrawsTheSame) {
  const auto record = tests::resonance(8);
  const auto innovations = Innovations::of(record);
  std::vector<double> one, same, other;
  Surrogates(record, *innovations, Null::permuted, 5).draw(one);
  Surrogates(record, *innovations, Null::permuted, 5).draw(same);
  Surrogates(record, *innovations, Null::permuted, 6).draw(other);
  EXPECT_EQ(one, same);
  EXPECT_NE(one, other);
}

}  // namespace
}  // namespace loopscope::core::hos
