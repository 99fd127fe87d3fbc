#include "daemon/backfill/backfill_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/text/failure.hpp"

namespace loopscope::daemon {
namespace {

TEST(ParseDuration, ReadsNumbersWithUnits) {
  EXPECT_EQ(parse_duration("90s"), 90'000'000);
  EXPECT_EQ(parse_duration("90"), 90'000'000);
  EXPECT_EQ(parse_duration("15min"), 900'000'000);
  EXPECT_EQ(parse_duration(" 1.5 h "), 5'400'000'000);
  EXPECT_EQ(parse_duration("1d"), 86'400'000'000);
  EXPECT_EQ(parse_duration("2w"), 14 * std::int64_t{86'400'000'000});
}

TEST(ParseDuration, RefusesAnythingElse) {
  for (const char* text : {"", "d", "1m", "1 month", "-1d", "0", "0.5s", "2000d", "1e3", "1d2",
                           "nan", "inf", "1,5h"}) {
    try {
      static_cast<void>(parse_duration(text));
      ADD_FAILURE() << text;
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.exit_code(), ExitCode::usage);
      EXPECT_EQ(std::string(failure.what()),
                "\"" + std::string(text) + "\" is not a time span of a second to a year");
      EXPECT_EQ(failure.hint(), "a number and s, min, h, d or w, e.g. 6h or 1d");
    }
  }
}

}  // namespace
}  // namespace loopscope::daemon
