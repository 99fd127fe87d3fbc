#include "config/read_tree.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/config/settings_text.hpp"

namespace loopscope::config::tests {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(ReadTree, UnknownKeysNameTheNearestKnownOne) {
  const std::string text = minimal_with(R"("schedule": {"pol_s": 5})");
  EXPECT_THAT(lines_of(text), ElementsAre("/schedule/pol_s: is not a known setting"));
  EXPECT_EQ(first_hint_of(text), "did you mean \"poll_s\"?");
}

TEST(ReadTree, KeysInTheWrongObjectAreToldWhereTheyBelong) {
  EXPECT_EQ(first_hint_of(minimal_with(R"("poll_s": 5)")), "it belongs to /schedule/poll_s");
}

TEST(ReadTree, KeysLikeNoOtherGetTheListOfKnownOnes) {
  EXPECT_EQ(
      first_hint_of(minimal_with(R"("daemon": {"colour": "red"})")),
      "known here: workers, batches_in_flight, cache_mb, log_level, log_format, http_address, "
      "http_names, max_lag_s, acknowledge");
}

TEST(ReadTree, KeysThatLookLikePathsAreUnknown) {
  EXPECT_THAT(lines_of(minimal_with(R"("schedule/poll_s": 5)")),
              ElementsAre("/schedule~1poll_s: is not a known setting"));
  EXPECT_THAT(lines_of(minimal_with(R"("historians/*/name": "x")")),
              ElementsAre("/historians~1*~1name: is not a known setting"));
}

TEST(ReadTree, SectionsMustBeObjects) {
  EXPECT_THAT(lines_of(minimal_with(R"("analysis": {"hos": 5}, "flags": [])")),
              ElementsAre("/analysis/hos: is a number, not an object",
                          "/flags: is an array, not an object"));
  EXPECT_THAT(lines_of("[]"), ElementsAre(": is an array, not an object"));
}

TEST(ReadTree, HistoriansMustBeAnArrayOfObjects) {
  const std::string results = R"({"results": {"connection": "a"}, "historians": )";
  EXPECT_THAT(lines_of(results + "{}}"),
              ElementsAre("/historians: is an object, not an array of objects"));
  EXPECT_THAT(first_hint_of(results + "{}}"), HasSubstr("brackets"));
  EXPECT_THAT(lines_of(results + R"([{"connection": "a"}, 7]})"),
              ElementsAre("/historians/1: is a number, not an object"));
}

TEST(ReadTree, RequiredSettingsAreMissedOnceEach) {
  EXPECT_THAT(lines_of(R"({"historians": [{"name": "a"}, {"name": "b", "connection": ""}]})"),
              ElementsAre("/historians/1/connection: is empty", "/results/connection: is missing",
                          "/historians/0/connection: is missing"));
}

TEST(ReadTree, NullIsNoDefault) {
  const std::string text = minimal_with(R"("schedule": {"poll_s": null})");
  EXPECT_THAT(lines_of(text),
              ElementsAre("/schedule/poll_s: is null, not a number, 0.1 to 3600 s"));
  EXPECT_THAT(first_hint_of(text), HasSubstr("leave the key out"));
}

TEST(ReadTree, FileWithEverySettingIsAccepted) {
  EXPECT_THAT(lines_of(complete_text()), IsEmpty());
}

}  // namespace
}  // namespace loopscope::config::tests
