#include "daemon/report/text/page_text.hpp"

#include <gtest/gtest.h>
#include <limits>

namespace loopscope::daemon {
namespace {

TEST(PageText, FiguresThatAreNotKnownAreADash) {
  EXPECT_EQ(two_decimals(0.625), "0.62");
  EXPECT_EQ(digits(0.012345), "0.0123");
  EXPECT_EQ(digits({}), "\u2013");
  EXPECT_EQ(digits(std::numeric_limits<double>::infinity()), "\u2013");
  EXPECT_EQ(p_text(1e-20), "< 1e-12");
  EXPECT_EQ(p_text({}), "\u2013");
  EXPECT_EQ(number_text(7), "7");
  EXPECT_EQ(number_text({}), "");
}

TEST(PageText, CodesBecomeWords) {
  EXPECT_EQ(in_words("valve_stiction"), "valve stiction");
  EXPECT_EQ(as_heading("valve_stiction"), "Valve stiction");
  EXPECT_EQ(as_heading(""), "");
  EXPECT_EQ(as_heading("\u00fcber"), "\u00fcber");
}

}  // namespace
}  // namespace loopscope::daemon
