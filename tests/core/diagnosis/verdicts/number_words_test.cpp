#include "core/diagnosis/verdicts/number_words.hpp"

#include <gtest/gtest.h>

namespace loopscope::core::diagnosis {
namespace {

TEST(Words, NumbersAreShort) {
  EXPECT_EQ(number(0.0123456), "0.0123");
  EXPECT_EQ(number(-2.0), "-2");
  EXPECT_EQ(percent(0.256), "26 %");
}

TEST(Words, PValuesEndWhereTheirDigitsSayNothing) {
  EXPECT_EQ(p_text(0.0312), "0.031");
  EXPECT_EQ(p_text(1.0), "1");
  EXPECT_EQ(p_text(2.5e-9), "2.5e-09");
  EXPECT_EQ(p_text(1e-12), "1e-12");
  EXPECT_EQ(p_text(9.9e-13), "< 1e-12");
  EXPECT_EQ(p_text(0.0), "< 1e-12");
  EXPECT_EQ(p_equals(0.03), "p = 0.03");
  EXPECT_EQ(p_equals(1e-308), "p < 1e-12");
}

TEST(Words, DurationsHaveTheUnitOfTheirSize) {
  EXPECT_EQ(duration(45.0), "45 s");
  EXPECT_EQ(duration(750.0), "12.5 min");
  EXPECT_EQ(duration(10'800.0), "3 h");
}

}  // namespace
}  // namespace loopscope::core::diagnosis
