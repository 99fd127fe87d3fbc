#include "core/hos/analyse.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/simulate/limit_cycle.hpp"
#include "tests/core/hos/signals.hpp"

namespace loopscope::core::hos {
namespace {

TEST(HosAnalyse, LinearSinusoidsAreLinearAndTheirSquareIsNot) {
  // Example 4.2: medians over 60 records are NGI -0.0005 and 0.0160 [0.0134 .. 0.0185], NLI 0.273
  // [0.236 .. 0.319] for the nonlinear one.
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto linear = analyse(tests::two_sinusoids(seed, 0.0), Settings{});
    const auto squared = analyse(tests::two_sinusoids(seed, 0.05), Settings{});
    ASSERT_TRUE(linear && squared);
    EXPECT_LT(linear->ngi, 0.005);
    EXPECT_GT(squared->ngi, 0.008);
    EXPECT_GT(squared->nli, 0.15);
    EXPECT_FALSE(squared->published.gaussian);
    EXPECT_FALSE(squared->published.linear);
    EXPECT_EQ(squared->coupling, Coupling::quadratic);
  }
}

TEST(HosAnalyse, PublishedDecisionTable) {
  const Settings settings;
  struct Row {
    double ngi, nli;
    bool gaussian, linear;
  };
  const Row table[] = {
      {-0.0028, 0.5, true, true},   // section 4.1: NLI is not looked at
      {0.0008, 0.0, true, true},    // 4.2, x
      {0.001, 0.5, true, true},     // beta itself still counts as zero
      {0.0011, 0.01, false, true},  // non-Gaussian, linear
      {0.0011, 0.0101, false, false}, {0.016, 0.233, false, false},  // 4.2, y
  };
  for (const Row& row : table) {
    const PublishedDecision found = published_decision(row.ngi, row.nli, settings);
    EXPECT_EQ(found.gaussian, row.gaussian) << row.ngi;
    EXPECT_EQ(found.linear, row.linear) << row.ngi << ' ' << row.nli;
  }
}

TEST(HosAnalyse, ShortRecordsUseTheNullOfTheirOwnSegments) {
  const auto result = analyse(tests::white_noise(61, 512), Settings{});
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(result->segments, 15U);
  // 127 / 15 times the critical mean of a whole record.
  EXPECT_NEAR(result->critical_mean_bic2, 0.008281982624294715 * 127.0 / 15.0, 1e-15);
  // The mean under the null is near 1 / K, and a single record strays by about its own tenth.
  EXPECT_NEAR(result->mean_bic2, 1.0 / 15.0, 0.02);
}

TEST(HosAnalyse, NothingToSayWithoutSegmentsOrVariance) {
  EXPECT_FALSE(analyse({}, Settings{}).has_value());
  EXPECT_FALSE(analyse(tests::white_noise(1, 95), Settings{}).has_value());
  EXPECT_FALSE(analyse(std::vector<double>(4096, 0.1), Settings{}).has_value());
  EXPECT_FALSE(analyse(std::vector<double>(4096, std::nan("")), Settings{}).has_value());
}

TEST(HosAnalyse, SettingsOutOfRangeThrowWhateverTheSignal) {
  EXPECT_THROW((void)analyse({}, {.dft_length = 32}), std::invalid_argument);
}

bool all_finite(const Result& result) {
  bool finite = true;
  for (const double value :
       {result.mean_bic2, result.std_bic2, result.max_bic2, result.critical_mean_bic2, result.ngi,
        result.nli, result.skewness, result.excess_kurtosis}) {
    finite = finite && std::isfinite(value);
  }
  return finite;
}

TEST(HosAnalyse, FiniteSamplesNeverGiveNan) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  constexpr double kSmallest = std::numeric_limits<double>::denorm_min();
  std::mt19937_64 generator(62);
  std::uniform_int_distribution<int> exponent(-1074, 1023);
  std::vector<std::vector<double>> signals;
  for (const double size : {kLargest, kSmallest, 1e-310, 1.0}) {
    std::vector<double> alternating(512, size);
    std::vector<double> spike(512, 0.0);
    std::vector<double> few_levels = tests::white_noise(63, 512);
    for (std::size_t k = 0; k < 512; k += 3) {
      alternating[k] = -size;
    }
    spike[200] = size;
    for (double& sample : few_levels) {
      sample = sample > 1.0 ? size : 0.0;
    }
    signals.insert(signals.end(), {alternating, spike, few_levels});
  }
  for (int record = 0; record < 20; ++record) {
    std::vector<double> wild = tests::white_noise(64, 512);
    for (double& sample : wild) {
      sample = std::ldexp(std::clamp(sample, -1.0, 1.0), exponent(generator));
    }
    signals.push_back(wild);
  }
  for (const auto& signal : signals) {
    const auto result = analyse(signal, Settings{});
    EXPECT_TRUE(!result || all_finite(*result)) << signal[0];
  }
}

TEST(HosAnalyse, ManyThreadsGetTheSameDigits) {
  const auto signal = tests::two_sinusoids(65, 0.05);
  // A DFT length that no other test plans: the first use is part of the race.
  const Settings settings{.dft_length = 142};
  std::vector<double> means(16);
  {
    std::vector<std::jthread> threads;
    for (double& mean : means) {
      threads.emplace_back([&] { mean = analyse(signal, settings)->mean_bic2; });
    }
  }
  for (const double mean : means) {
    EXPECT_EQ(mean, analyse(signal, settings)->mean_bic2);
  }
}

TEST(HosAnalyse, TheSeedDrivesTheSecondPassAlone) {
  const auto skewed = tests::exponential_noise(66);
  const auto one = analyse(skewed, Settings{}, 1).value();
  EXPECT_EQ(one.nonlinear_p, analyse(skewed, Settings{}, 1)->nonlinear_p);
  EXPECT_NE(one.nonlinear_p, analyse(skewed, Settings{}, 2)->nonlinear_p);
  EXPECT_EQ(one.ngi_p, analyse(skewed, Settings{}, 2)->ngi_p);
  EXPECT_EQ(one.mean_bic2, analyse(skewed, Settings{}, 2)->mean_bic2);
}

TEST(HosAnalyse, TheCouplingIsTheKindThatIsSignificant) {
  // Two sinusoids and their square have no third harmonic, a triangle has odd harmonics only, a
  // sawtooth has all.
  const auto wave = [](simulate::WaveShape shape, double period) {
    return simulate::limit_cycle({.shape = shape, .period_samples = period}, 4096, 67);
  };
  EXPECT_EQ(analyse(wave(simulate::WaveShape::triangle, 30.0), Settings{})->coupling,
            Coupling::cubic);
  EXPECT_EQ(analyse(wave(simulate::WaveShape::sawtooth, 16.0), Settings{})->coupling,
            Coupling::both);
  EXPECT_EQ(analyse(tests::two_sinusoids(67, 0.05), Settings{})->coupling, Coupling::quadratic);
  int found_in_noise = 0;  // in one record of twenty on average
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const auto noise = analyse(tests::white_noise(seed), Settings{});
    found_in_noise += noise->coupling == Coupling::none_found ? 0 : 1;
  }
  EXPECT_LE(found_in_noise, 8);
}

TEST(HosAnalyse, CouplingsHaveTheNamesOfTheContract) {
  EXPECT_EQ(name(Coupling::none_found), "none_found");
  EXPECT_EQ(name(Coupling::quadratic), "quadratic");
  EXPECT_EQ(name(Coupling::cubic), "cubic");
  EXPECT_EQ(name(Coupling::both), "both");
}

}  // namespace
}  // namespace loopscope::core::hos
