#include "core/hos/linear/noise_shape.hpp"

#include <cstdio>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "core/simulate/coloured_noise.hpp"
#include "core/simulate/disturbances.hpp"
#include "core/simulate/missing_samples.hpp"
#include "tests/core/hos/family_rates.hpp"
#include "tests/core/hos/rejections.hpp"
#include "tests/core/hos/uniformity.hpp"
#include "tests/support/chance.hpp"

namespace loopscope::core::hos {
namespace {

using loopscope::tests::four_errors;
using simulate::Innovation;

struct ShapeRates {
  std::vector<double> tails, light, skewness, variance;

  void add(const NoiseShape& shape) {
    tails.push_back(shape.tails_p);
    light.push_back(shape.light_tails_p);
    skewness.push_back(shape.skewness_p);
    variance.push_back(shape.variance_p);
  }
};

ShapeRates rates_of(const tests::Draw& draw, int records) {
  ShapeRates rates;
  for (int seed = 1; seed <= records; ++seed) {
    const auto record = draw(static_cast<std::uint64_t>(seed));
    rates.add(noise_shape(Innovations::of(record, best_kernels(), {.largest = 8}).value()));
  }
  for (const double level : {0.05, 0.001}) {
    std::printf("| %5.1f | %5.1f | %5.1f | %5.1f ", 100.0 * tests::share_below(rates.tails, level),
                100.0 * tests::share_below(rates.light, level),
                100.0 * tests::share_below(rates.skewness, level),
                100.0 * tests::share_below(rates.variance, level));
  }
  std::printf("|\n");
  return rates;
}

tests::Draw coloured(Innovation law, std::size_t samples = 4096) {
  return [=](std::uint64_t seed) {
    return simulate::coloured_noise(simulate::real_pole(0.9), law, samples, seed);
  };
}

TEST(HosNoiseShape, OfNormalNoiseEachPHoldsItsLevel) {
  const int records = tests::records(600);
  for (const std::size_t samples : {4096U, 700U}) {
    const ShapeRates rates = rates_of(coloured(Innovation::gaussian, samples), records);
    for (const auto* p : {&rates.tails, &rates.light, &rates.skewness, &rates.variance}) {
      EXPECT_LE(tests::share_below(*p, 0.05), 0.07 + four_errors(0.07, records));
      EXPECT_LE(tests::share_below(*p, 0.001), 0.004 + four_errors(0.004, records));
    }
  }
}

TEST(HosNoiseShape, FindsEachKindAndNotTheOther) {
  const int records = tests::records(60);
  const double nearly_all = 0.98 - four_errors(0.02, records);
  for (const Innovation law :
       {Innovation::student_5, Innovation::student_3, Innovation::contaminated}) {
    const ShapeRates rates = rates_of(coloured(law), records);
    EXPECT_GE(tests::share_below(rates.tails, 1e-3), nearly_all) << name(law);
    EXPECT_LE(tests::share_below(rates.variance, 1e-3), 0.03 + four_errors(0.03, records));
  }
  for (const Innovation law : {Innovation::bursts, Innovation::garch}) {
    const ShapeRates rates = rates_of(coloured(law), records);
    EXPECT_GE(tests::share_below(rates.variance, 1e-3), nearly_all) << name(law);
  }
  EXPECT_GE(tests::share_below(rates_of(coloured(Innovation::uniform), records).light, 1e-3),
            nearly_all);
  EXPECT_GE(tests::share_below(rates_of(coloured(Innovation::exponential), records).skewness, 1e-3),
            nearly_all);
}

TEST(HosNoiseShape, SaysWhereItIsLoudest) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto record = simulate::with_level(
        simulate::innovations(Innovation::gaussian, 4096, seed), 0.5, 0.6, 4.0);
    const NoiseShape shape = noise_shape(Innovations::of(record).value());
    EXPECT_LT(shape.variance_p, 1e-10);
    EXPECT_NEAR(static_cast<double>(shape.loudest_first), 2048.0, 40.0);
    EXPECT_NEAR(static_cast<double>(shape.loudest_size), 410.0, 80.0);
    EXPECT_NEAR(shape.loudest_ratio, 4.0, 0.6);
  }
}

TEST(HosNoiseShape, PlacesAreThoseOfTheRecordWhateverIsMissing) {
  auto record =
      simulate::with_level(simulate::innovations(Innovation::gaussian, 4096, 3), 0.5, 0.6, 4.0);
  for (std::size_t t = 200; t < 900; ++t) record[t] = std::nan("");
  const NoiseShape shape = noise_shape(Innovations::of(record).value());
  EXPECT_NEAR(static_cast<double>(shape.loudest_first), 2048.0, 40.0);
}

TEST(HosNoiseShape, TooFewInnovationsSayNothing) {
  const auto record = simulate::innovations(Innovation::student_3, 110, 1);
  const auto innovations = Innovations::of(record);
  ASSERT_TRUE(innovations.has_value());
  const NoiseShape shape = noise_shape(*innovations);
  EXPECT_LE(shape.tails_p, 1.0);
  EXPECT_GT(shape.variance_p, 0.0);
}

}  // namespace
}  // namespace loopscope::core::hos
