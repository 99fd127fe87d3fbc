#include "daemon/report/sections/loop_list.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/daemon/report/markup.hpp"

namespace loopscope::daemon {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(LoopList, LinksToLoopsThatHaveAPage) {
  storage::LoopRow seen, never;
  seen.name = "a&b";
  seen.code = "healthy";
  never.name = "never";
  const std::string text = loop_list({seen, never});
  EXPECT_THAT(text, HasSubstr("href=\"/loop?name=a%26b\""));
  EXPECT_THAT(text, HasSubstr("<bdi>never</bdi>"));
  EXPECT_THAT(text, Not(HasSubstr("name=never")));
  EXPECT_THAT(text, HasSubstr("never analysed"));
  EXPECT_EQ(unbalanced(text), "");
}

TEST(LoopList, OfAVeryLargePlantTheFirstRowsAndHowManyThereAre) {
  const std::string text = loop_list(std::vector<storage::LoopRow>(5001));
  EXPECT_THAT(text, HasSubstr("The first 5000 of 5001 loops, flagged ones before others"));
}

}  // namespace
}  // namespace loopscope::daemon
