#include "core/diagnosis/odds/cause_curves.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <set>

#include "core/diagnosis/evidence/figure.hpp"
#include "core/diagnosis/verdicts/verdict.hpp"

namespace loopscope::core::diagnosis {
namespace {

TEST(CauseCurves, AreStraightBetweenTheirPointsAndLevelOutside) {
  const FigureCurve curve{"oscillation.p", -0.5, {{1.0, 0.0}, {3.0, 2.0}, {4.0, -1.0}}};
  EXPECT_EQ(weight_at(curve, 0.0), 0.0);
  EXPECT_EQ(weight_at(curve, 1.0), 0.0);
  EXPECT_DOUBLE_EQ(weight_at(curve, 2.0), 1.0);
  EXPECT_DOUBLE_EQ(weight_at(curve, 3.0), 2.0);
  EXPECT_DOUBLE_EQ(weight_at(curve, 3.5), 0.5);
  EXPECT_EQ(weight_at(curve, 1e9), -1.0);
  EXPECT_EQ(weight_at(curve, std::nan("")), -0.5);
  EXPECT_EQ(weight_at({"oscillation.p", 0.25, {}}, 1.0), 0.25);
}

void expect_sound(const CauseCurves& cause) {
  EXPECT_TRUE(verdict_code(cause.cause)) << cause.cause;
  EXPECT_GT(cause.share, 0.0) << cause.cause;
  EXPECT_LT(cause.share, 1.0) << cause.cause;
  std::set<std::string_view> figures;
  for (const FigureCurve& curve : cause.curves) {
    EXPECT_TRUE(figure_place(curve.figure)) << curve.figure;
    EXPECT_TRUE(figures.insert(curve.figure).second) << curve.figure;
    EXPECT_TRUE(std::ranges::is_sorted(curve.points, {}, &CurvePoint::value)) << curve.figure;
    for (const CurvePoint& point : curve.points) {
      EXPECT_TRUE(std::isfinite(point.weight)) << curve.figure;
      EXPECT_LT(std::abs(point.weight), 12.0) << cause.cause << " " << curve.figure;
    }
  }
}

TEST(CauseCurves, TheFittedTablesHoldEveryCauseOnceAndKnownFiguresOnly) {
  for (const bool with_model : {true, false}) {
    std::set<std::string_view> causes;
    for (const CauseCurves& cause : fitted_curves(with_model)) {
      expect_sound(cause);
      EXPECT_TRUE(causes.insert(cause.cause).second) << cause.cause;
    }
    EXPECT_EQ(causes.size(), 13U) << "twelve causes and any nonlinearity";
  }
}

}  // namespace
}  // namespace loopscope::core::diagnosis
