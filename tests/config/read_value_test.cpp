#include "config/read_value.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>

namespace loopscope::config::tests {
namespace {

using Json = nlohmann::ordered_json;

/// The message for a value that is read into `place`; empty when it is accepted.
template <typename Value>
std::string message_for(const char* json, const Limits& limits, Value& place) {
  ProblemList problems;
  read_value(Json::parse(json), "/x", limits, &place, problems);
  return problems.problems().empty() ? std::string() : problems.problems().front().message;
}

TEST(ReadValue, RangesAreInclusive) {
  double value = 0.0;
  EXPECT_EQ(message_for("0.1", range(0.1, 3600, "s"), value), "");
  EXPECT_EQ(value, 0.1);
  EXPECT_EQ(message_for("3600", range(0.1, 3600, "s"), value), "");
  EXPECT_EQ(value, 3600.0);
}

TEST(ReadValue, RefusedValuesLeaveTheSettingAlone) {
  double value = 7.0;
  EXPECT_EQ(message_for("3600.5", range(0.1, 3600, "s"), value),
            "3600.5 is out of range, 0.1 to 3600 s");
  EXPECT_EQ(message_for("true", range(0, 1), value), "is true, not a number, 0 to 1");
  EXPECT_EQ(message_for("[1]", range(0, 1), value), "is an array, not a number, 0 to 1");
  EXPECT_EQ(value, 7.0);
}

TEST(ReadValue, NumbersAreWholeByValueNotBySpelling) {
  int value = 0;
  for (const char* spelling : {"64", "64.0", "6.4e1"}) {
    EXPECT_EQ(message_for(spelling, range(0, 100), value), "") << spelling;
    EXPECT_EQ(value, 64) << spelling;
  }
  EXPECT_EQ(message_for("64.5", range(0, 100), value), "64.5 is not a whole number, 0 to 100");
}

TEST(ReadValue, HugeAndNegativeNumbersDoNotWrapAround) {
  std::size_t value = 5;
  for (const char* huge : {"18446744073709551616", "9223372036854775808", "1e300", "-1", "-1e300"})
    EXPECT_THAT(message_for(huge, range(0, 50, "peaks"), value),
                testing::EndsWith("is out of range, 0 to 50 peaks"))
        << huge;
  EXPECT_EQ(value, 5U);
}

TEST(ReadValue, SwitchesTakeTrueAndFalseOnly) {
  bool value = true;
  EXPECT_EQ(message_for("false", any(Form::toggle), value), "");
  EXPECT_FALSE(value);
  EXPECT_EQ(message_for("1", any(Form::toggle), value), "is a number, not true or false");
  EXPECT_EQ(message_for("\"true\"", any(Form::toggle), value), "is a text, not true or false");
  EXPECT_EQ(message_for("null", any(Form::toggle), value), "is null, not true or false");
  EXPECT_FALSE(value);
}

TEST(ReadValue, TextRules) {
  std::string value = "kept";
  EXPECT_EQ(message_for("\"\"", any(Form::text), value), "is empty");
  EXPECT_EQ(message_for(R"("a\u0000b")", any(Form::text), value), "holds a control character");
  EXPECT_EQ(message_for("5", any(Form::text), value), "is a number, not a text");
  EXPECT_EQ(message_for(R"("password=x")", any(Form::connection), value), "holds a password");
  EXPECT_EQ(value, "kept");
  EXPECT_EQ(message_for(R"("password=x")", any(Form::text), value), "");
  EXPECT_EQ(message_for("\"\"", any(Form::optional_connection), value), "");
  EXPECT_EQ(value, "");
}

TEST(ReadValue, ChoicesNameTheNearestWord) {
  constexpr std::string_view kWords[] = {"debug", "info"};
  std::string value;
  ProblemList problems;
  read_value(Json("Info"), "/x", one_of(kWords), &value, problems);
  ASSERT_EQ(problems.problems().size(), 1U);
  EXPECT_EQ(problems.problems()[0].message, "\"Info\" is none of debug, info");
  EXPECT_EQ(problems.problems()[0].hint, "did you mean \"info\"?");
}

}  // namespace
}  // namespace loopscope::config::tests
