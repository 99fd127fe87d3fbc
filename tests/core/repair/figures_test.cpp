#include "core/repair/figures.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "tests/core/repair/repair_sample.hpp"

namespace loopscope::core::repair {
namespace {

FigureChange find(const std::vector<FigureChange>& changes, std::string_view name) {
  const auto found =
      std::ranges::find_if(changes, [&](const FigureChange& c) { return c.kind->name == name; });
  return found == changes.end() ? FigureChange{} : *found;
}

TEST(RepairFigures, OneWindowHasTheOrdinaryScatter) {
  Side one = kSound;
  one.windows = 1;
  const FigureChange error =
      find(compare_figures(repair_between(one, with_error(one, 2.0, 0.5))), "error_std");
  // Four windows' worth of freedom: t = 1.645 + 1.524 / 4 + 1.42 / 16.
  const double t = 2.11475, ordinary = 0.07, apart = 0.12;
  ASSERT_TRUE(error.change);
  EXPECT_NEAR(error.change->value, 2.0, 1e-12);
  EXPECT_NEAR(std::log(error.change->high / 2.0),
              t * std::sqrt(2.0 * ordinary * ordinary + apart * apart), 1e-12);
  EXPECT_NEAR(std::log(error.before->high), t * ordinary, 1e-12);
  EXPECT_NEAR(error.weight.value(),
              std::log(2.0) / (t * std::sqrt(2.0 * ordinary * ordinary + apart * apart)), 1e-12);
}

TEST(RepairFigures, TheOwnStandardErrorOfTheErrorWidensTheInterval) {
  RepairWindows windows = repair_between(kSound, kSound);
  const double narrow = find(compare_figures(windows), "error_std").change->high;
  for (RepairWindow& window : windows.before) window.error_log_variance_se = 0.5;
  EXPECT_GT(find(compare_figures(windows), "error_std").change->high, narrow);
}

TEST(RepairFigures, DifferencesAreComparedAsSuch) {
  RepairWindows windows = repair_between(kSound, kSound);
  for (RepairWindow& window : windows.before) window.nli = 0.10, window.nonlinear_p = 1e-50;
  for (RepairWindow& window : windows.after) window.nli = 0.04, window.nonlinear_p = 0.1;
  const auto changes = compare_figures(windows);
  EXPECT_NEAR(find(changes, "nli").change->value, -0.06, 1e-12);
  EXPECT_NEAR(find(changes, "nonlinear_p").before->value, 30.0, 1e-12) << "at most";
  EXPECT_NEAR(find(changes, "nonlinear_p").change->value, -29.0, 1e-12);
}

TEST(RepairFigures, AnEffectThatEnteredTwiceCountsOnce) {
  Side side = kSticks;
  side.effects = {{"valve_stiction", "S", 4.0}, {"valve_deadband", "width", 9.0}};
  const auto changes = compare_figures(repair_between(side, side));
  EXPECT_NEAR(find(changes, "friction_band").before->value, 4.0, 1e-12);
  EXPECT_NEAR(find(changes, "valve_deadband.width").before->value, 9.0, 1e-12);
}

TEST(RepairFigures, ASideWithoutTheFigureHasNoChange) {
  const auto changes =
      compare_figures(repair_between(with_effect(kSticks, {"valve_stiction", "S", 4.0}), kSound));
  const FigureChange band = find(changes, "friction_band");
  EXPECT_TRUE(band.before);
  EXPECT_FALSE(band.after);
  EXPECT_FALSE(band.change);
  EXPECT_EQ(band.windows_before, 2U);
  EXPECT_EQ(find(changes, "curvature").kind, nullptr) << "nobody has it";
  EXPECT_TRUE(std::ranges::is_sorted(changes, {}, [](const auto& c) { return c.kind->name; }));
}

TEST(RepairFigures, WhatIsNoNumberOrNotPositiveIsLeftOut) {
  RepairWindows windows = repair_between(kSound, kSound);
  windows.before[0].error_std = std::nan("");
  windows.after[0].error_std = 0.0;
  const FigureChange error = find(compare_figures(windows), "error_std");
  EXPECT_EQ(error.windows_before, 1U);
  EXPECT_EQ(error.windows_after, 1U);
}

/// Loops that nobody touched, whose error scatters as FigureKind says: in 10 of 100 the interval
/// of the change leaves 1 out, within two and a half standard errors.
TEST(RepairFigures, NineOfTenUntouchedLoopsLieWithinTheInterval) {
  constexpr int kRepairs = 4000;
  for (const std::size_t windows : {1U, 2U, 6U}) {
    std::mt19937_64 random(7 + windows);
    std::normal_distribution<double> normal;
    Side side = kSound;
    side.windows = windows;
    int outside = 0;
    for (int repair = 0; repair < kRepairs; ++repair) {
      RepairWindows drawn = repair_between(side, side);
      const double state = 0.12 * normal(random);
      for (RepairWindow& window : drawn.before) window.error_std = std::exp(0.07 * normal(random));
      for (RepairWindow& window : drawn.after)
        window.error_std = std::exp(state + 0.07 * normal(random));
      const Interval change = *find(compare_figures(drawn), "error_std").change;
      if (change.low > 1.0 || change.high < 1.0) ++outside;
    }
    const double share = static_cast<double>(outside) / kRepairs;
    // The interval is a Student's with few degrees of freedom about a scatter that is known: it is
    // wide rather than narrow where windows are few.
    EXPECT_LT(share, 0.10 + 2.5 * std::sqrt(0.09 / kRepairs)) << windows;
    EXPECT_GT(share, 0.03) << windows;
  }
}

}  // namespace
}  // namespace loopscope::core::repair
