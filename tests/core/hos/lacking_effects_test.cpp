// What the published null model lacks, effect by effect: how often a test at nominal 5 % rejects
// records in which there is nothing to find, before the effect is allowed for and after.
//
// LOOPSCOPE_RECORDS=2000 core_tests --gtest_filter='HosLackingEffects.*' makes MEASURED.md's table.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <gtest/gtest.h>
#include <span>
#include <string>
#include <string_view>

#include "core/hos/analyse.hpp"
#include "core/hos/coupling/null_laws.hpp"
#include "core/hos/coupling/overlap.hpp"
#include "core/hos/coupling/quadratic_test.hpp"
#include "core/hos/coupling/tested_spectra.hpp"
#include "core/simulate/calibration_families.hpp"
#include "tests/core/hos/family_rates.hpp"
#include "tests/support/long_run.hpp"

namespace loopscope::core::hos {
namespace {

using Signal = std::span<const double>;
using Decision = std::function<bool(Signal)>;

constexpr double kLevel = 0.05;

struct BeforeAndAfter {
  double before = 0.0;
  double after = 0.0;
};

std::size_t record_count() {
  return loopscope::tests::all_records(100);
}

using tests::family;

/// Compares two tests on the same records and prints a line of the table.
BeforeAndAfter compare(const char* effect, std::string_view name, const Decision& before,
                       const Decision& after) {
  const std::size_t records = record_count();
  BeforeAndAfter rates;
  for (std::size_t seed = 0; seed < records; ++seed) {
    const auto record = family(name).draw(family(name).samples, 40'000 + seed);
    rates.before += before(record) ? 1.0 / static_cast<double>(records) : 0.0;
    rates.after += after(record) ? 1.0 / static_cast<double>(records) : 0.0;
  }
  std::printf("| %s | %s | %.1f %% | %.1f %% |\n", effect, std::string(name).c_str(),
              100.0 * rates.before, 100.0 * rates.after);
  return rates;
}

/// The size has to hold; 3.5 standard errors of the records drawn are allowed on top.
void expect_held(const BeforeAndAfter& rates, double least_before) {
  const double error = std::sqrt(0.07 * 0.93 / static_cast<double>(record_count()));
  EXPECT_LE(rates.after, 0.07 + 3.5 * error);
  EXPECT_GE(rates.before, least_before);
}

/// K times the mean of bic2 over the testable cells, with the segments as they come.
QuadraticStatistics plain_statistics(Signal signal, const Settings& settings) {
  Bicoherence bicoherence(settings);
  const auto bic2 = bicoherence.estimate(signal);
  return QuadraticTest(settings).measure(bicoherence, bic2);
}

Decision ngi_above(double limit) {
  return [limit](Signal signal) { return analyse(signal, {})->ngi > limit; };
}

/// The mean's test without any precaution.
bool plain_mean_rejects(Signal signal) {
  Bicoherence bicoherence{Settings{}};
  const auto bic2 = bicoherence.estimate(signal);
  const QuadraticTest test{Settings{}};
  return test.mean_p(test.measure(bicoherence, bic2), bicoherence.segments()) <= kLevel;
}

bool ngi_p_rejects(Signal signal) {
  return *analyse(signal, {})->ngi_p <= kLevel;
}

bool nonlinear_p_rejects(Signal signal) {
  return *analyse(signal, {})->nonlinear_p <= kLevel;
}

TEST(HosLackingEffects, NeighboursAreCorrelated) {
  const auto independent = [](Signal signal) {
    const double cells = static_cast<double>(TestableCells(Settings{}).count());
    return mean_law_upper(plain_statistics(signal, {}).mean, 1.0, 1.0 / std::sqrt(cells)) <= kLevel;
  };
  expect_held(compare("correlated neighbours", "white", independent, ngi_p_rejects), 0.2);
}

TEST(HosLackingEffects, SegmentsOverlap) {
  Settings settings;
  settings.overlap = 0.75;
  const auto mean_of_one = [settings](Signal signal) {
    const Overlap overlap(settings);
    const double cells = static_cast<double>(TestableCells(settings).count());
    return mean_law_upper(plain_statistics(signal, settings).mean, 1.0,
                          std::sqrt(overlap.correlated_cells() / cells)) <= kLevel;
  };
  const auto as_is = [settings](Signal signal) {
    return *analyse(signal, settings)->ngi_p <= kLevel;
  };
  expect_held(compare("overlap of 75 %", "white", mean_of_one, as_is), 0.9);
}

TEST(HosLackingEffects, EdgeCellsShareAMainLobe) {
  const auto all_cells = [](Signal signal) {
    const auto result = analyse(signal, {});
    const double k = static_cast<double>(result->segments);
    const Overlap overlap{Settings{}};
    const double cells = static_cast<double>(result->bifrequencies);
    return mean_law_upper(k * result->mean_bic2, overlap.mean(),
                          std::sqrt(overlap.correlated_cells() / cells)) <= kLevel;
  };
  expect_held(compare("edge cells", "random_walk", all_cells, ngi_p_rejects), 0.1);
}

TEST(HosLackingEffects, SteepSpectraLeak) {
  expect_held(
      compare("leakage of a steep spectrum", "integrated_walk", plain_mean_rejects, ngi_p_rejects),
      0.9);
}

TEST(HosLackingEffects, FewSegmentsVaryMore) {
  expect_held(compare("few segments", "white_1000", ngi_above(0.001), ngi_p_rejects), 0.15);
}

TEST(HosLackingEffects, MaskedSegmentsAreFewer) {
  expect_held(compare("masked segments", "white_gaps", ngi_above(0.001), ngi_p_rejects), 0.12);
}

TEST(HosLackingEffects, LinesKeepTheirPhase) {
  expect_held(
      compare("line locked to the hop", "sinusoid_16_at_20_db", plain_mean_rejects, ngi_p_rejects),
      0.08);
  expect_held(
      compare("line locked to the hop", "sinusoid_32_at_20_db", plain_mean_rejects, ngi_p_rejects),
      0.3);
}

TEST(HosLackingEffects, VarianceChanges) {
  expect_held(compare("changing variance", "ar1_0.9_half_twice", plain_mean_rejects, ngi_p_rejects),
              0.9);
  expect_held(
      compare("changing variance", "ar1_0.9_tenth_thrice", plain_mean_rejects, ngi_p_rejects), 0.9);
}

TEST(HosLackingEffects, OneUpsetIsNotTheLoop) {
  expect_held(compare("single upset", "ar1_0.9_one_step", plain_mean_rejects, ngi_p_rejects), 0.8);
}

TEST(HosLackingEffects, NoiseIsSkewedOrHeavyTailed) {
  for (const std::string_view name : {"ar1_0.9_exponential", "ar1_0.9_laplace"}) {
    expect_held(
        compare("skewed or heavy-tailed noise", name, plain_mean_rejects, nonlinear_p_rejects),
        0.3);
  }
}

}  // namespace
}  // namespace loopscope::core::hos
