#include "storage/array_literal.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <vector>

namespace loopscope::storage {
namespace {

TEST(ArrayLiteral, WritesEveryKindOfElement) {
  ArrayLiteral array;
  EXPECT_EQ(array.text(), "{}");
  array.add_integer(-5);
  array.add_null();
  array.add_boolean(true);
  array.add_number(0.1);
  array.add_number(std::nullopt);
  array.add_time(0);
  EXPECT_EQ(array.text(), R"({-5,NULL,t,0.1,NULL,"1970-01-01 00:00:00.000000+00"})");
}

TEST(ArrayLiteral, NumbersThatAreNoneBecomeNull) {
  ArrayLiteral array;
  array.add_number(std::numeric_limits<double>::quiet_NaN());
  array.add_number(-std::numeric_limits<double>::infinity());
  EXPECT_EQ(array.text(), "{NULL,NULL}");
}

TEST(ArrayLiteral, QuotesText) {
  ArrayLiteral array;
  array.add_text("");
  array.add_text("NULL");
  array.add_text(R"(a"b\c,{d})");
  EXPECT_EQ(array.text(), R"({"","NULL","a\"b\\c,{d}"})");
}

TEST(ArrayLiteral, ListInsideIsOneElement) {
  ArrayLiteral array;
  array.add_text_list(std::vector<std::string>{"x", "y\""});
  array.add_text_list({});
  EXPECT_EQ(array.text(), R"({"{\"x\",\"y\\\"\"}","{}"})");
}

TEST(ArrayLiteral, RealsThatFourBytesCannotHoldAreZero) {
  ArrayLiteral array;
  array.add_real_list(std::vector<std::optional<double>>{0.25, std::nullopt, 1e-60, -1e-300});
  array.add_real_list({});
  EXPECT_EQ(array.text(), R"({"{0.25,NULL,0,0}",NULL})");
}

TEST(NumberText, ReadsBackAsTheSameValue) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> value(0.0, 1e3);
  for (int i = 0; i < 10000; ++i) {
    const double number = value(random);
    EXPECT_EQ(std::stod(number_text(number)), number);
  }
  EXPECT_EQ(number_text(std::numeric_limits<double>::quiet_NaN()), "nan");
  EXPECT_EQ(number_text(-std::numeric_limits<double>::infinity()), "-inf");
}

}  // namespace
}  // namespace loopscope::storage
