#include "core/hos/coupling/tested_spectra.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <gtest/gtest.h>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/hos/coupling/locked_line.hpp"
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

/// Whatever precautions the workspace's record before has called for.
TEST(HosTestedSpectra, InAWorkspaceItIsAsIfPublished) {
  Bicoherence workspace(Settings{});
  for (const auto* const name :
       {"white", "integrated_walk", "sinusoid_16_at_20_db", "ar1_0.9_bursts", "ar1_0.9_half_twice",
        "ar1_0.9_one_step", "ar1_0.9_gaps"}) {
    const Looked published(draw(name, 3));
    const TestedSpectra tested(published.signal, workspace, Settings{});
    EXPECT_EQ(tested.precautions().differenced, published.tested.precautions().differenced);
    EXPECT_EQ(tested.settings().overlap, published.tested.settings().overlap);
    EXPECT_EQ(tested.levels().has_value(), published.tested.levels().has_value());
    EXPECT_TRUE(std::ranges::equal(tested.bic2(), published.tested.bic2())) << name;
  }
}

TEST(HosTestedSpectra, KeepsTheRecordAsItWasGiven) {
  const Looked looked(draw("ar1_0.9_one_step", 1));
  EXPECT_EQ(looked.tested.recorded().data(), looked.signal.data());
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

}  // namespace
}  // namespace loopscope::core::hos
