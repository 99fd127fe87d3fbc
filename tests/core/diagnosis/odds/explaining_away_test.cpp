#include "core/diagnosis/odds/explaining_away.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "core/diagnosis/odds/cause_curves.hpp"
#include "core/diagnosis/odds/combined_odds.hpp"
#include "core/diagnosis/odds/log_odds.hpp"

namespace loopscope::core::diagnosis {
namespace {

const ExplainingAway kAlone;
const ExplainingAway kBeside{0.9, -0.1, {{-4.0, 1.0}, {4.0, -1.0}}, {{-4.0, -2.0}, {4.0, 2.0}}};

std::vector<OwnOdds> loop(double sticks, double wave, double nonlinear) {
  return {{VerdictCode::valve_stiction, sticks, &kBeside},
          {VerdictCode::external_disturbance, wave, &kBeside},
          {VerdictCode::healthy, -2.0, &kBeside},
          {VerdictCode::nonlinear_unexplained, nonlinear, &kAlone}};
}

/// Rivals are taken to be independent: that any is there is 1 less that none is.
TEST(ExplainingAway, TheOthersCountTogether) {
  const auto all = loop(0.5, 1.5, 0.0);
  const auto parts = parts_of_others(0, all);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_NEAR(parts[0].probability,
              1.0 - (1.0 - probability_of(1.5)) * (1.0 - probability_of(-2.0)), 1e-12);
  EXPECT_EQ(parts[0].first, VerdictCode::external_disturbance);
  EXPECT_NEAR(parts[1].probability, 0.5, 1e-12);
  EXPECT_EQ(parts[1].first, VerdictCode::nonlinear_unexplained);
  EXPECT_NEAR(explaining_away(0.5, 0, all), 0.9 * 0.5 - 0.1 + parts[0].weight + parts[1].weight,
              1e-12);
}

TEST(ExplainingAway, WhatAnotherCauseExplainsNeedsNoSecondOne) {
  EXPECT_LT(explaining_away(0.5, 0, loop(0.5, 4.0, 0.0)),
            explaining_away(0.5, 0, loop(0.5, -4.0, 0.0)));
}

TEST(ExplainingAway, ANonlinearityWantsACause) {
  EXPECT_GT(explaining_away(0.5, 0, loop(0.5, 0.0, 4.0)),
            explaining_away(0.5, 0, loop(0.5, 0.0, -4.0)));
}

TEST(ExplainingAway, OneThatStandsAloneKeepsItsOdds) {
  EXPECT_EQ(explaining_away(0.7, 3, loop(0.5, 4.0, 0.7)), 0.7);
  EXPECT_TRUE(parts_of_others(3, loop(0.5, 4.0, 0.7)).empty());
}

TEST(ExplainingAway, WithoutAnyOtherNothingIsAdded) {
  const std::vector<OwnOdds> lonely = {{VerdictCode::valve_stiction, 0.5, &kBeside}};
  EXPECT_DOUBLE_EQ(explaining_away(0.5, 0, lonely), 0.9 * 0.5 - 0.1);
}

TEST(ExplainingAway, CertaintyStaysANumber) {
  EXPECT_TRUE(std::isfinite(explaining_away(900.0, 0, loop(900.0, 900.0, 900.0))));
  // log odds of -inf: the first point of the curve.
  const std::vector<OwnOdds> none = {{VerdictCode::valve_stiction, -900.0, &kBeside},
                                     {VerdictCode::healthy, -900.0, &kBeside}};
  EXPECT_DOUBLE_EQ(explaining_away(-900.0, 0, none), 0.9 * -900.0 - 0.1 + 1.0);
}

bool is_nonlinear(VerdictCode code) {
  return code >= VerdictCode::valve_stiction && code <= VerdictCode::process_nonlinearity;
}

void expect_sound(VerdictCode code, const ExplainingAway& beside) {
  const double sign = is_nonlinear(code) ? 1.0 : -1.0;
  EXPECT_GT(beside.scale, 0.0) << name(code);
  EXPECT_EQ(beside.rival.empty(), beside.nonlinear.empty()) << name(code);
  for (std::size_t k = 1; k < beside.rival.size(); ++k) {
    EXPECT_LT(beside.rival[k - 1].value, beside.rival[k].value) << name(code);
    EXPECT_GE(beside.rival[k - 1].weight, beside.rival[k].weight) << name(code);
  }
  for (std::size_t k = 1; k < beside.nonlinear.size(); ++k) {
    EXPECT_LT(beside.nonlinear[k - 1].value, beside.nonlinear[k].value) << name(code);
    EXPECT_LE(sign * beside.nonlinear[k - 1].weight, sign * beside.nonlinear[k].weight)
        << name(code);
  }
}

/// A rival never helps; a nonlinearity helps those that are one and no others.
TEST(ExplainingAway, TheFittedCurvesGoTheirWay) {
  for (const bool with_model : {true, false}) {
    for (const CauseCurves& cause : fitted_curves(with_model)) {
      const VerdictCode code = verdict_code(cause.cause).value();
      expect_sound(code, cause.beside);
      expect_sound(code, fitted_windows().at(code).beside);
    }
  }
}

}  // namespace
}  // namespace loopscope::core::diagnosis
