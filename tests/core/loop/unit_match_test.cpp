#include "core/loop/unit_match.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "tests/core/loop/unit_loops.hpp"
#include "tests/support/chance.hpp"
#include "tests/support/long_run.hpp"

namespace loopscope::core::loop {
namespace {

using signals::Random;
using signals::Series;
using signals::Setpoint;

UnitConversion conversion(const std::string& words) {
  for (UnitConversion& known : unit_conversions(signal::OpRange{0.0, 250.0}))
    if (known.words == words) return known;
  ADD_FAILURE() << words;
  return {};
}

TEST(UnitMatch, ConversionsComeBack) {
  const auto there = [](const std::string& words, double value) {
    const UnitConversion known = conversion(words);
    return known.offset + known.factor * value;
  };
  EXPECT_NEAR(there("converted from degF to degC", 212.0), 100.0, 1e-12);
  EXPECT_NEAR(there("converted from degC to degF", 100.0), 212.0, 1e-12);
  EXPECT_NEAR(there("converted from K to degC", 273.15), 0.0, 1e-12);
  EXPECT_NEAR(there("converted from bar to psi", 1.0), 14.5038, 1e-4);
  EXPECT_NEAR(there("converted from kPa to psi", 100.0), 14.5038, 1e-4);
  EXPECT_NEAR(there("divided by 100", 50.0), 0.5, 1e-12);
  EXPECT_NEAR(there("taken as percent of pv's range", 50.0), 125.0, 1e-12);
  EXPECT_NEAR(there("in percent of pv's range", 125.0), 50.0, 1e-12);
  double shares = 0.0;
  for (const UnitConversion& known : unit_conversions(signal::OpRange{0.0, 250.0}))
    shares += known.share;
  EXPECT_NEAR(shares, 1.0, 1e-12);
}

/// The trial's loop: 70.3 degF beside 21.3 degC.
TEST(UnitMatch, ASetpointAtRestIsADoubt) {
  Random random(1);
  Series pv = signals::ar1(random, 4096, 0.9);
  for (double& value : pv) value = 21.28 + 0.1 * value;
  const auto match = match_units(Series(4096, 70.3), pv, std::nullopt);
  ASSERT_TRUE(match);
  EXPECT_EQ(match->conversion.words, "converted from degF to degC");
  EXPECT_GT(match->probability, 0.7);
  EXPECT_FALSE(match->follows);
  EXPECT_EQ(match->slope, 0.0);
}

TEST(UnitMatch, ASetpointThatMovesShowsIt) {
  Random random(2);
  Series sp(4096, 70.0);
  for (std::size_t k = 1000; k < 2500; ++k) sp[k] = 90.0;
  Series pv = signals::ar1(random, 4096, 0.9);
  for (std::size_t k = 0; k < pv.size(); ++k) pv[k] = (sp[k] - 32.0) / 1.8 + 0.1 * pv[k];
  const auto match = match_units(sp, pv, std::nullopt);
  ASSERT_TRUE(match);
  EXPECT_EQ(match->conversion.words, "converted from degF to degC");
  EXPECT_GT(match->probability, 0.99);
  EXPECT_TRUE(match->follows);
  EXPECT_NEAR(match->slope, 1.0 / 1.8, 0.02);
  EXPECT_NEAR(match->offset, -17.8, 1.5);
}

TEST(UnitMatch, PercentOfARangeIsAskedForWhereTheRangeIsKnown) {
  Random random(3);
  Series sp(4096, 40.0);
  for (std::size_t k = 2000; k < 4096; ++k) sp[k] = 55.0;
  Series pv = signals::ar1(random, 4096, 0.8);
  for (std::size_t k = 0; k < pv.size(); ++k) pv[k] = 20.0 + 2.3 * sp[k] + 0.3 * pv[k];
  const auto known = match_units(sp, pv, signal::OpRange{20.0, 250.0});
  EXPECT_EQ(known->conversion.words, "taken as percent of pv's range");
  EXPECT_TRUE(known->follows && known->probability > 0.99);
  const auto unknown = match_units(sp, pv, std::nullopt);
  EXPECT_LT(unknown->probability, 0.5);
}

TEST(UnitMatch, TooLittleIsNotJudged) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(match_units(Series(20, 1.0), Series(20, 2.0), std::nullopt));
  EXPECT_FALSE(match_units(Series{}, Series(4096, 2.0), std::nullopt));
  EXPECT_FALSE(match_units(Series(4096, nan), Series(4096, 2.0), std::nullopt));
  Series sp(4096, 1.0);
  for (std::size_t k = 0; k < 2200; ++k) sp[k] = nan;
  EXPECT_FALSE(match_units(sp, Series(4096, 2.0), std::nullopt));
}

/// Numbers that no plant has give a probability all the same.
TEST(UnitMatch, OddNumbersStayFinite) {
  for (const double size : {0.0, 1e-300, 1e300, -1e300}) {
    Series sp(4096, size);
    sp[7] = 1.0;
    const auto match = match_units(sp, Series(4096, size), std::nullopt);
    if (!match) continue;
    EXPECT_TRUE(match->probability >= 0.0 && match->probability <= 1.0) << size;
  }
}

/// What is said of loops whose units are the same; tables unit_match_size.
TEST(UnitMatch, LoopsElsewhereAreHardlyEverDoubtedAndNeverShown) {
  const std::size_t records = tests::records(500);
  double doubted = 0.0;
  for (const auto setpoint : signals::kSetpoints) {
    for (const auto why : signals::kElsewhere) {
      const auto shares = signals::shares_elsewhere(setpoint, why, records, 1);
      EXPECT_EQ(shares.shown, 0.0) << name(why) << ' ' << name(setpoint);
      EXPECT_LE(shares.doubted, 0.01 + tests::four_errors(0.01, records)) << name(why);
      doubted += shares.doubted / 15.0;
    }
  }
  EXPECT_LE(doubted, 0.004 + tests::four_errors(0.004, 15 * records));
}

/// tables unit_match_power.
TEST(UnitMatch, LoopsInOtherUnitsAreFound) {
  const std::size_t records = tests::records(200);
  const auto found = [&](Setpoint setpoint, const std::string& words) {
    return signals::shares_in_units(setpoint, conversion(words), records, 1);
  };
  const double error = tests::four_errors(0.9, records);
  EXPECT_GE(found(Setpoint::rests, "converted from degF to degC").doubted, 0.9 - error);
  EXPECT_GE(found(Setpoint::steps, "converted from degF to degC").doubted, 0.95 - error);
  EXPECT_GE(found(Setpoint::steps, "times 10").shown, 0.85 - error);
  EXPECT_GE(found(Setpoint::cascade, "times 100").shown, 0.95 - error);
  EXPECT_LE(found(Setpoint::steps, "converted from degC to degF").wrong, 0.02);
}

}  // namespace
}  // namespace loopscope::core::loop
