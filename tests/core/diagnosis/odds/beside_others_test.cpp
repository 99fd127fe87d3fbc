#include "core/diagnosis/odds/beside_others.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "core/diagnosis/odds/cause_curves.hpp"
#include "core/diagnosis/odds/combined_odds.hpp"
#include "core/diagnosis/odds/log_odds.hpp"

namespace loopscope::core::diagnosis {
namespace {

const BesideOthers kAlone;
const BesideOthers kBeside{0.9, -0.1, {{-4.0, 1.0}, {4.0, -1.0}}, {{-4.0, -2.0}, {4.0, 2.0}}};

std::vector<OwnOdds> loop(double sticks, double wave, double nonlinear) {
  return {{VerdictCode::valve_stiction, sticks, &kBeside},
          {VerdictCode::external_disturbance, wave, &kBeside},
          {VerdictCode::healthy, -2.0, &kBeside},
          {VerdictCode::nonlinear_unexplained, nonlinear, &kAlone}};
}

/// Rivals are taken to be independent: that any is there is 1 less that none is.
TEST(BesideOthers, TheOthersCountTogether) {
  const auto all = loop(0.5, 1.5, 0.0);
  const auto parts = parts_of_others(0, all);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_NEAR(parts[0].probability,
              1.0 - (1.0 - probability_of(1.5)) * (1.0 - probability_of(-2.0)), 1e-12);
  EXPECT_EQ(parts[0].first, VerdictCode::external_disturbance);
  EXPECT_NEAR(parts[1].probability, 0.5, 1e-12);
  EXPECT_EQ(parts[1].first, VerdictCode::nonlinear_unexplained);
  EXPECT_NEAR(beside_others(0.5, 0, all), 0.9 * 0.5 - 0.1 + parts[0].weight + parts[1].weight,
              1e-12);
}

TEST(BesideOthers, WhatAnotherCauseExplainsNeedsNoSecondOne) {
  EXPECT_LT(beside_others(0.5, 0, loop(0.5, 4.0, 0.0)),
            beside_others(0.5, 0, loop(0.5, -4.0, 0.0)));
}

TEST(BesideOthers, ANonlinearityWantsACause) {
  EXPECT_GT(beside_others(0.5, 0, loop(0.5, 0.0, 4.0)),
            beside_others(0.5, 0, loop(0.5, 0.0, -4.0)));
}

TEST(BesideOthers, OneThatStandsAloneKeepsItsOdds) {
  EXPECT_EQ(beside_others(0.7, 3, loop(0.5, 4.0, 0.7)), 0.7);
  EXPECT_TRUE(parts_of_others(3, loop(0.5, 4.0, 0.7)).empty());
}

TEST(BesideOthers, WithoutAnyOtherNothingIsAdded) {
  const std::vector<OwnOdds> lonely = {{VerdictCode::valve_stiction, 0.5, &kBeside}};
  EXPECT_DOUBLE_EQ(beside_others(0.5, 0, lonely), 0.9 * 0.5 - 0.1);
}

TEST(BesideOthers, CertaintyStaysANumber) {
  EXPECT_TRUE(std::isfinite(beside_others(900.0, 0, loop(900.0, 900.0, 900.0))));
  // log odds of -inf: the first point of the curve.
  const std::vector<OwnOdds> none = {{VerdictCode::valve_stiction, -900.0, &kBeside},
                                     {VerdictCode::healthy, -900.0, &kBeside}};
  EXPECT_DOUBLE_EQ(beside_others(-900.0, 0, none), 0.9 * -900.0 - 0.1 + 1.0);
}

bool is_nonlinear(VerdictCode code) {
  return code >= VerdictCode::valve_stiction && code <= VerdictCode::process_nonlinearity;
}

void expect_sound(VerdictCode code, const BesideOthers& beside) {
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
TEST(BesideOthers, TheFittedCurvesGoTheirWay) {
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
