#include "core/hos/tested_spectra.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <gtest/gtest.h>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/hos/locked_line.hpp"
#include "core/simulate/limit_cycle.hpp"
#include "tests/core/hos/family_rates.hpp"
#include "tests/core/hos/rejections.hpp"
#include "tests/core/hos/signals.hpp"
#include "tests/support/chance.hpp"

namespace loopscope::core::hos {
namespace {

using loopscope::tests::four_errors;

/// A record with the spectra that are tested; holds what these point to.
struct Looked {
  explicit Looked(std::vector<double> record, const Settings& settings = {})
      : signal(std::move(record)),
        published(settings),
        published_bic2(published.estimate(signal)),
        tested(signal, published, published_bic2, settings) {}

  [[nodiscard]] std::size_t masked() const {
    return static_cast<std::size_t>(
        std::count_if(tested.signal().begin(), tested.signal().end(),
                      [](double sample) { return std::isnan(sample); }));
  }
  [[nodiscard]] bool untouched() const {
    return !tested.precautions().differenced && tested.precautions().overlap == 0.5 &&
           !tested.levels() && tested.bic2().data() == published_bic2.data() && masked() == 0;
  }

  std::vector<double> signal;
  Bicoherence published;
  std::span<const double> published_bic2;
  TestedSpectra tested;
};

std::vector<double> draw(std::string_view name, std::uint64_t seed) {
  const auto& family = tests::family(name);
  return family.draw(family.samples, 600'000 + seed);
}

/// Share of the records of a family for which something holds.
template <typename Holds>
double share(std::string_view name, int records, const Holds& holds) {
  double result = 0.0;
  for (int seed = 1; seed <= records; ++seed) {
    const Looked looked(draw(name, static_cast<std::uint64_t>(seed)));
    result += holds(looked) ? 1.0 / records : 0.0;
  }
  std::printf("| %s | %.1f %% |\n", std::string(name).c_str(), 100.0 * result);
  return result;
}

TEST(HosTestedSpectra, WhiteNoiseNeedsNoPrecaution) {
  const int records = tests::records(1000);
  const auto untouched = [](const Looked& looked) { return looked.untouched(); };
  EXPECT_GE(share("white", records, untouched), 0.99 - four_errors(0.01, records));
}

TEST(HosTestedSpectra, AnIntegratedWalkIsDifferenced) {
  const auto differenced = [](const Looked& looked) {
    return looked.tested.precautions().differenced;
  };
  EXPECT_NEAR(share("integrated_walk", 50, differenced), 1.0, 1e-9);
  EXPECT_EQ(share("random_walk", 50, differenced), 0.0);
}

TEST(HosTestedSpectra, DifferencesAreThoseOfTheRecord) {
  const Looked looked(draw("integrated_walk", 1));
  ASSERT_TRUE(looked.tested.precautions().differenced);
  std::vector<double> differences(looked.signal.size());
  for (std::size_t n = 1; n < differences.size(); ++n) {
    differences[n] = looked.signal[n] - looked.signal[n - 1];
  }
  differences[0] = differences[1];
  Bicoherence own{Settings{.overlap = looked.tested.precautions().overlap}};
  const auto expected = own.estimate(differences);
  if (looked.tested.levels()) GTEST_SKIP() << "this record is levelled too";
  ASSERT_EQ(looked.tested.bic2().size(), expected.size());
  EXPECT_TRUE(std::equal(expected.begin(), expected.end(), looked.tested.bic2().begin()));
}

TEST(HosTestedSpectra, ALockedLineGetsAnotherOverlap) {
  const int records = tests::records(50);
  for (const auto* const name : {"sinusoid_16_at_20_db", "sinusoid_32_at_20_db"}) {
    const auto unlocked = [](const Looked& looked) {
      const double overlap = looked.tested.precautions().overlap;
      return overlap != 0.5 && looked.tested.settings().overlap == overlap &&
             !has_locked_line(looked.tested.bicoherence().spectra());
    };
    EXPECT_GE(share(name, records, unlocked), 1.0 - four_errors(0.01, records)) << name;
  }
}

TEST(HosTestedSpectra, AHalfTwiceAsLoudGetsLevels) {
  const int records = tests::records(50);
  const auto levelled = [](const Looked& looked) {
    return looked.tested.levels() && looked.masked() == 0;
  };
  EXPECT_GE(share("ar1_0.9_half_twice", records, levelled), 0.99 - four_errors(0.01, records));
}

TEST(HosTestedSpectra, OneStepIsMasked) {
  const int records = tests::records(50);
  const auto masked_there = [](const Looked& looked) {
    return std::isnan(looked.tested.signal()[2048]) && looked.masked() <= 256;
  };
  EXPECT_GE(share("ar1_0.9_one_step", records, masked_there), 0.95 - four_errors(0.05, records));
}

TEST(HosTestedSpectra, ALimitCyclesJumpsAreNotMasked) {
  const int records = tests::records(100);
  const auto masked = [](const Looked& looked) { return looked.masked() > 0; };
  EXPECT_LE(share("square_400", records, masked), four_errors(0.01, records));
  EXPECT_LE(share("square_64", records, masked), four_errors(0.01, records));
}

TEST(HosTestedSpectra, TheNextReplicateIsAsIfItWereTheFirst) {
  const auto first = tests::exponential_noise(21);
  const auto second = tests::white_noise(22);
  for (const bool differenced : {false, true}) {
    const Precautions precautions{differenced, 0.5625};
    TestedSpectra used(first, precautions, Settings{});
    used.look_at(second);
    const TestedSpectra fresh(second, precautions, Settings{});
    EXPECT_TRUE(std::equal(used.bic2().begin(), used.bic2().end(), fresh.bic2().begin(),
                           fresh.bic2().end()));
  }
}

TEST(HosTestedSpectra, AReplicateTakesThePrecautionsItIsGiven) {
  const auto record = tests::white_noise(3);
  const TestedSpectra plain(record, Precautions{}, Settings{});
  EXPECT_FALSE(plain.levels().has_value());
  const TestedSpectra moved(record, Precautions{true, 0.5625}, Settings{});
  EXPECT_EQ(moved.settings().overlap, 0.5625);
  EXPECT_TRUE(moved.precautions().differenced);
  // Hops of 28 samples instead of 32.
  EXPECT_EQ(moved.bicoherence().segments(), 145U);
  EXPECT_EQ(plain.bicoherence().segments(), 127U);
}

TEST(HosTestedSpectra, SurvivesGapsAndNothing) {
  auto torn = draw("ar1_0.9_one_step", 2);
  for (std::size_t n = 100; n < 1500; ++n) torn[n] = std::nan("");
  const Looked looked(torn);
  EXPECT_FALSE(looked.tested.bic2().empty());
  for (const double value : looked.tested.bic2()) EXPECT_TRUE(std::isfinite(value));
  EXPECT_TRUE(Looked(std::vector<double>(4096, 1.0)).tested.bic2().empty());
  EXPECT_TRUE(Looked({}).tested.bic2().empty());
}

TEST(HosTestedSpectra, SettingsOutOfRangeThrow) {
  const auto record = tests::white_noise(1);
  EXPECT_THROW(TestedSpectra(record, Precautions{}, {.dft_length = 7}), std::invalid_argument);
}

}  // namespace
}  // namespace loopscope::core::hos
