#include "daemon/report/text/pv_unit.hpp"

#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

TEST(PvUnit, TheCatalogueSaysIt) {
  EXPECT_EQ(in_pv_unit("by -12 units of pv, then 1 unit of pv", "m3/h"),
            "by -12 m3/h, then 1 m3/h");
  EXPECT_EQ(in_pv_unit("one lag, gain 2.5 pv per %", "m3/h"), "one lag, gain 2.5 m3/h per %");
  EXPECT_EQ(in_pv_unit("pv units", "\u00b0C"), "\u00b0C");
  EXPECT_EQ(in_pv_unit("pv is quiet", "m3/h"), "pv is quiet");
}

TEST(PvUnit, WithoutOneItIsAUnitOfPv) {
  EXPECT_EQ(in_pv_unit("pv units", ""), "units of pv");
  EXPECT_EQ(in_pv_unit("1 unit of pv, gain 2 pv per %", ""), "1 unit of pv, gain 2 pv per %");
}

/// A unit is what somebody typed.
TEST(PvUnit, AUnitThatNamesItselfEnds) {
  EXPECT_EQ(in_pv_unit("2 pv units", "units of pv units"), "2 units of pv units");
}

}  // namespace
}  // namespace loopscope::daemon
