#include "daemon/report/figures/gnuplot_text.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(GnuplotText, DataBlocksBreakWhereNothingIsKnown) {
  EXPECT_EQ(data_block("pv", std::vector<Point>{{1.0, 2.5}, {2.0, NAN}, {3.0, 1e-9}}),
            "$pv << EOD\n1 2.5\n\n3 1e-09\nEOD\n");
}

TEST(GnuplotText, AnAxisHoldsItsValuesAndHasFewTics) {
  EXPECT_THAT(value_axis(0.0, 10.0, "op (%)"), HasSubstr("set yrange [-0.6:10.6]\nset ytics 5\n"));
  EXPECT_THAT(value_axis(48.1, 52.4, "pv"), HasSubstr("set ytics 2\n"));
  // A constant has a range too.
  EXPECT_THAT(value_axis(5.0, 5.0, "pv"), Not(HasSubstr("[5:5]")));
  EXPECT_THAT(value_axis(0.0, 0.0, "pv"), Not(HasSubstr("[0:0]")));
}

// Beside the axis it was cut off by wide figures at the tics, and in low panels.
TEST(GnuplotText, TheLabelOfAValueStandsAboveItsAxis) {
  EXPECT_THAT(value_axis(100'200.0, 100'900.0, "sp, pv (pv units)"),
              HasSubstr("set label 99 'sp, pv (pv units)' at graph 0, graph 1 left"));
  EXPECT_THAT(value_axis(0.0, 1.0, "pv"), Not(HasSubstr("ylabel")));
}

TEST(GnuplotText, PanelsStandOneAboveTheOtherWithinTheCanvas) {
  EXPECT_THAT(panel(0, 1, 320), HasSubstr("set tmargin at screen 0.9313\n"));
  EXPECT_THAT(panel(2, 3, 320), HasSubstr("set bmargin at screen 0.1500\n"));
}

}  // namespace
}  // namespace loopscope::daemon
