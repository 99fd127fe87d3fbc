#include "daemon/replay/compare_figures.hpp"

#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

using nlohmann::json;

const json kFigures{{"ngi", 0.25},
                    {"hos_slow", nullptr},
                    {"flags", {"short", "sp_moving"}},
                    {"verdict", {{"code", "healthy"}, {"reasons", {"NGI 0.25, NLI 0.1"}}}},
                    {"steps", json::array({{{"p", 0.001}, {"evidence", 12.0}}})}};

TEST(CompareFigures, OfTheSameAreIdentical) {
  const FigureComparison result = compare_figures(kFigures, kFigures);
  EXPECT_EQ(result.compared, 8U);
  EXPECT_EQ(result.different, 0U);
  EXPECT_EQ(result.name, "");
}

TEST(CompareFigures, NamesTheFarthestNumber) {
  json other = kFigures;
  other["ngi"] = 0.250001;
  other["steps"][0]["evidence"] = 15.0;
  const FigureComparison result = compare_figures(kFigures, other);
  EXPECT_EQ(result.different, 2U);
  EXPECT_EQ(result.name, "steps/0/evidence");
  EXPECT_EQ(result.before, "12.0");
  EXPECT_EQ(result.after, "15.0");
  EXPECT_DOUBLE_EQ(result.relative, 0.2);
}

TEST(CompareFigures, AnotherWordIsFartherThanAnyNumberAndTheDigitsOfASentenceAreNot) {
  json other = kFigures;
  other["ngi"] = -0.25;
  other["verdict"]["reasons"][0] = "NGI -0.25, NLI 0.1";
  EXPECT_EQ(compare_figures(kFigures, other).name, "ngi");
  other["verdict"]["code"] = "valve_stiction";
  const FigureComparison result = compare_figures(kFigures, other);
  EXPECT_EQ(result.name, "verdict/code");
  EXPECT_EQ(result.different, 3U);
}

TEST(CompareFigures, WhatIsMissingAndNullAgainstANumberAreNoMatterOfDigits) {
  json other = kFigures;
  other.erase("ngi");
  EXPECT_EQ(compare_figures(kFigures, other).after, "nothing");
  other = kFigures;
  other["ngi"] = nullptr;
  EXPECT_EQ(compare_figures(kFigures, other).relative, 3.0);
}

}  // namespace
}  // namespace loopscope::daemon
