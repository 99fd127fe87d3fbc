#include "core/text/phrases.hpp"

#include <gtest/gtest.h>
#include <limits>

namespace loopscope::core::text {
namespace {

TEST(Phrases, NumbersHaveThreeDigits) {
  EXPECT_EQ(number(3.14159), "3.14");
  EXPECT_EQ(number(0.0123456), "0.0123");
  EXPECT_EQ(number(-2.0), "-2");
  EXPECT_EQ(number(12345.0), "1.23e+04");
  EXPECT_EQ(number(std::numeric_limits<double>::infinity()), "inf");
}

TEST(Phrases, ADisplayShowsNoExponentWhereItNeedsNone) {
  EXPECT_EQ(display_number(999.4), "999");
  EXPECT_EQ(display_number(12345.0), "12300");
  EXPECT_EQ(display_number(-9'990'000.0), "-9990000");
  EXPECT_EQ(display_number(2.5e7), "2.5e+07");
  EXPECT_EQ(display_number(0.00001234), "1.23e-05");
  EXPECT_EQ(display_number(std::numeric_limits<double>::quiet_NaN()), "nan");
}

TEST(Phrases, FixedDecimals) {
  EXPECT_EQ(fixed(0.5, 2), "0.50");
  EXPECT_EQ(fixed(1234.4, 0), "1234");
}

TEST(Phrases, SizesInAnUnknownUnit) {
  EXPECT_EQ(units_of_pv(1.0), "1 unit of pv");
  EXPECT_EQ(units_of_pv(0.9999), "1 unit of pv");
  EXPECT_EQ(units_of_pv(-12.0), "-12 units of pv");
  EXPECT_EQ(units_of_pv(0.5), "0.5 units of pv");
}

TEST(Phrases, PValuesEndWhereTheirDigitsSayNothing) {
  EXPECT_EQ(p_text(0.0312), "0.031");
  EXPECT_EQ(p_text(1.0), "1");
  EXPECT_EQ(p_text(2.5e-9), "2.5e-09");
  EXPECT_EQ(p_text(1e-12), "1e-12");
  EXPECT_EQ(p_text(9.9e-13), "< 1e-12");
  EXPECT_EQ(p_text(0.0), "< 1e-12");
  EXPECT_EQ(p_equals(0.03), "p = 0.03");
  EXPECT_EQ(p_equals(1e-308), "p < 1e-12");
}

TEST(Phrases, DurationsHaveTheUnitOfTheirSize) {
  EXPECT_EQ(duration(45.0), "45 s");
  EXPECT_EQ(duration(750.0), "12.5 min");
  EXPECT_EQ(duration(10'800.0), "3 h");
  EXPECT_EQ(duration(11'520.0), "3.2 h");
  EXPECT_EQ(at_place(1840, 1.0), "30.7 min into the window (sample 1840)");
}

TEST(Phrases, SharesAreWholePercentages) {
  EXPECT_EQ(percent(0.123), "12 %");
  EXPECT_EQ(percent(0.256), "26 %");
  EXPECT_EQ(percent(12.34), "1234 %");
  EXPECT_EQ(whole_percent(0.966), 97);
}

TEST(Phrases, CodesAreWords) {
  EXPECT_EQ(code_words("valve_stiction"), "valve stiction");
  EXPECT_EQ(code_words("op.rest_visits"), "op rest visits");
  EXPECT_EQ(code_words("not sure enough (0.40)."), "not sure enough (0.40).");
}

TEST(Phrases, APartBecomesASentence) {
  EXPECT_EQ(as_sentence("the gaps are long"), "The gaps are long.");
  EXPECT_EQ(as_sentence("3 samples are missing"), "3 samples are missing.");
  EXPECT_EQ(as_sentence("pv is constant"), "pv is constant.");
  EXPECT_EQ(as_sentence(""), "");
}

TEST(Phrases, ASentenceIsItsPartsInARow) {
  EXPECT_EQ(sentence("op turns ", 12345.678, " times in ", 3, " h."),
            "op turns 1.23e+04 times in 3 h.");
}

}  // namespace
}  // namespace loopscope::core::text
