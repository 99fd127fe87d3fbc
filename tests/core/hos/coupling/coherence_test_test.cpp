#include "core/hos/coupling/coherence_test.hpp"

#include <cmath>
#include <complex>
#include <functional>
#include <gtest/gtest.h>
#include <numeric>
#include <random>
#include <vector>

#include "tests/core/hos/rejections.hpp"
#include "tests/core/hos/uniformity.hpp"
#include "tests/support/chance.hpp"

namespace loopscope::core::hos {
namespace {

using loopscope::tests::four_errors;

using Complex = std::complex<double>;
using Sequence = std::vector<Complex>;

const Sequence kIndependent = {1.0};

std::vector<std::size_t> every_hop(std::size_t count) {
  std::vector<std::size_t> positions(count);
  std::iota(positions.begin(), positions.end(), 0U);
  return positions;
}

class ComplexNormal {
 public:
  explicit ComplexNormal(std::uint64_t seed) : generator_(seed) {}
  Complex operator()() { return {normal_(generator_), normal_(generator_)}; }
  Sequence sequence(std::size_t count) {
    Sequence values(count);
    for (Complex& value : values) value = (*this)();
    return values;
  }

 private:
  std::mt19937_64 generator_;
  std::normal_distribution<double> normal_;
};

/// p-values of `draws` pairs of what follows (`products`) and noise (`values`).
std::vector<double> p_values(int draws, std::size_t count, const Sequence& correlation,
                             const std::function<Sequence(ComplexNormal&)>& products,
                             const std::function<Sequence(ComplexNormal&)>& values) {
  ComplexNormal normal(17);
  const auto positions = every_hop(count);
  std::vector<double> p;
  for (int draw = 0; draw < draws; ++draw) {
    const Sequence w = products(normal);
    const Sequence x = values(normal);
    p.push_back(std::exp(-coherence_evidence({w, x, positions, correlation})));
  }
  return p;
}

TEST(HosCoherenceTest, OfTwoSegmentsIsTheShareOfPowerThatDoesNotFollow) {
  const Sequence w = {1.0, 0.0};
  const Sequence x = {{0.6, 0.0}, {0.0, 0.8}};
  const auto positions = every_hop(2);
  EXPECT_NEAR(coherence_evidence({w, x, positions, kIndependent}), -std::log(1.0 - 0.36), 1e-14);
}

TEST(HosCoherenceTest, IsTheBetaLawForIndependentSegments) {
  ComplexNormal normal(3);
  const Sequence w = normal.sequence(12);
  const Sequence x = normal.sequence(12);
  Complex sum;
  double follows = 0.0;
  double power = 0.0;
  for (std::size_t s = 0; s < w.size(); ++s) {
    sum += std::conj(w[s]) * x[s];
    follows += std::norm(w[s]);
    power += std::norm(x[s]);
  }
  const double coherence = std::norm(sum) / (follows * power);
  const auto positions = every_hop(12);
  EXPECT_NEAR(coherence_evidence({w, x, positions, kIndependent}),
              -11.0 * std::log(1.0 - coherence), 1e-12);
}

TEST(HosCoherenceTest, IsUniformForIndependentSegmentsWhateverIsFollowed) {
  for (const std::size_t count : {4U, 20U, 127U}) {
    const auto noise = [count](ComplexNormal& normal) { return normal.sequence(count); };
    const auto heavy_tailed = [count](ComplexNormal& normal) {
      Sequence w = normal.sequence(count);
      for (Complex& value : w) value *= value * value * std::norm(value);
      return w;
    };
    const int draws = tests::records(5000);
    EXPECT_LT(tests::distance_from_uniform(p_values(draws, count, kIndependent, noise, noise)),
              tests::kLargestDistance);
    EXPECT_LT(
        tests::distance_from_uniform(p_values(draws, count, kIndependent, heavy_tailed, noise)),
        tests::kLargestDistance);
  }
}

/// Moving average of order one of independent noise; `weight` makes its correlation.
std::function<Sequence(ComplexNormal&)> moving_average(std::size_t count, Complex weight) {
  return [=](ComplexNormal& normal) {
    const Sequence e = normal.sequence(count + 1);
    Sequence x(count);
    for (std::size_t s = 0; s < count; ++s) x[s] = e[s] + weight * e[s + 1];
    return x;
  };
}

TEST(HosCoherenceTest, HoldsItsLevelOnOverlappingSegments) {
  // Correlations of 1/6 (half overlap) and 0.49 (three quarters), turning as at some frequency;
  // what is followed is correlated the same way, which is the worst case.
  constexpr std::size_t kCount = 127;
  const int draws = tests::records(10'000);
  for (const Complex weight : {Complex(0.17), std::polar(0.17, 2.0), std::polar(0.8, 1.0)}) {
    const Sequence correlation = {1.0, weight / (1.0 + std::norm(weight))};
    const auto p = p_values(draws, kCount, correlation, moving_average(kCount, weight),
                            moving_average(kCount, weight));
    for (const double level : {0.05, 0.01, 0.001}) {
      // The power's freedom is matched in its second moment only: a fifth of the level.
      EXPECT_NEAR(tests::share_below(p, level), level, four_errors(level, draws) + 0.2 * level)
          << weight << ' ' << level;
    }
  }
}

TEST(HosCoherenceTest, OverlapLeftOutWouldNotHoldIt) {
  constexpr std::size_t kCount = 127;
  const auto noise = moving_average(kCount, 0.8);
  const auto p = p_values(4000, kCount, kIndependent, noise, noise);
  EXPECT_GT(tests::share_below(p, 0.05), 0.07);
}

TEST(HosCoherenceTest, SegmentsBeyondAGapAreIndependent) {
  ComplexNormal normal(5);
  const Sequence w = normal.sequence(6);
  const Sequence x = normal.sequence(6);
  const std::vector<std::size_t> apart = {0, 2, 4, 9, 11, 13};
  const Sequence correlation = {1.0, 0.4};
  EXPECT_DOUBLE_EQ(coherence_evidence({w, x, apart, correlation}),
                   coherence_evidence({w, x, apart, kIndependent}));
}

TEST(HosCoherenceTest, DoesNotDependOnScaleOrPhase) {
  ComplexNormal normal(6);
  Sequence w = normal.sequence(20);
  Sequence x = normal.sequence(20);
  const auto positions = every_hop(20);
  const Sequence correlation = {1.0, {0.1, 0.1}};
  const double before = coherence_evidence({w, x, positions, correlation});
  for (Complex& value : w) value *= std::polar(1e30, 1.0);
  for (Complex& value : x) value *= std::polar(1e-30, 2.0);
  EXPECT_NEAR(coherence_evidence({w, x, positions, correlation}), before, 1e-12 * before);
}

TEST(HosCoherenceTest, PerfectCoherenceIsFiniteAndNothingIsNoEvidence) {
  ComplexNormal normal(7);
  const Sequence w = normal.sequence(20);
  const Sequence zeros(20);
  const auto positions = every_hop(20);
  const double perfect = coherence_evidence({w, w, positions, kIndependent});
  EXPECT_GT(perfect, 400.0);
  EXPECT_TRUE(std::isfinite(perfect));
  EXPECT_EQ(coherence_evidence({w, zeros, positions, kIndependent}), 0.0);
  EXPECT_EQ(coherence_evidence({zeros, w, positions, kIndependent}), 0.0);
  const Sequence one = {1.0};
  const auto first = every_hop(1);
  EXPECT_EQ(coherence_evidence({one, one, first, kIndependent}), 0.0);
  EXPECT_EQ(coherence_evidence({{}, {}, {}, kIndependent}), 0.0);
}

}  // namespace
}  // namespace loopscope::core::hos
