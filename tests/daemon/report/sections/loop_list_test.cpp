#include "daemon/report/sections/loop_list.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/report/text/html_text.hpp"
#include "tests/daemon/report/markup.hpp"
#include "tests/support/hostile_names.hpp"

namespace loopscope::daemon {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(LoopList, LinksToLoopsThatHaveAPage) {
  storage::LoopRow seen, never;
  seen.name = "a&b";
  seen.code = "healthy";
  never.name = "never";
  const std::string text = loop_list({seen, never}, {}).html;
  EXPECT_THAT(text, HasSubstr("href=\"/loop?name=a%26b\""));
  EXPECT_THAT(text, HasSubstr("<bdi>never</bdi>"));
  EXPECT_THAT(text, Not(HasSubstr("name=never")));
  EXPECT_THAT(text, HasSubstr("never analysed"));
  EXPECT_EQ(unbalanced(text), "");
}

TEST(LoopList, OfAVeryLargePlantTheFirstRowsAndHowManyThereAre) {
  const std::string text = loop_list(std::vector<storage::LoopRow>(5001), {}).html;
  EXPECT_THAT(text, HasSubstr("The first 5000 of 5001 loops, flagged ones before others"));
}

TEST(LoopList, NoHostileNameChangesTheMarkup) {
  const auto list_with = [](const std::string& text) {
    storage::LoopRow row;
    row.name = row.source = row.health = text;
    row.loop_type = row.code = row.status = row.follows = row.shown_code = text;
    storage::LoopRow hidden = row;
    hidden.status.reset();
    hidden.hidden_by = text;
    hidden.shown_code = "external_disturbance";
    return loop_list({row, hidden}, {}).html;
  };
  for (const auto& [about, name] : tests::hostile_names()) {
    EXPECT_EQ(tags_of(list_with(name)), tags_of(list_with("words"))) << about << ": " << name;
    EXPECT_THAT(list_with(name), HasSubstr("<bdi>" + html(name) + "</bdi></a>")) << about;
  }
}

}  // namespace
}  // namespace loopscope::daemon
