#include "daemon/report/plant/annotated_table.hpp"

#include <gmock/gmock.h>

#include "tests/daemon/report/markup.hpp"

namespace loopscope::daemon {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr std::int64_t kSaidUs = 1'772'366'400'000'000;  // 2026-03-01T12:00:00Z

storage::PlantCounts counts() {
  storage::PlantCounts counts;
  counts.annotations = 3;
  counts.newest_annotations = {
      {1,
       "FIC101",
       "valve_stiction",
       {"acknowledged", "order 4711", "ls", kSaidUs, {}, {}, {}, "<J. Doe>"}},
      {2,
       "TIC 7",
       "tight_tuning",
       {"suppressed", "shut down", "eve", kSaidUs, kSaidUs + 3'600'000'000, {}, {}}},
      {3, "LIC9", "sensor_fault", {"false_positive", "", "eve", kSaidUs, {}, {}, {}}}};
  return counts;
}

TEST(AnnotatedTable, TellsWhoSaidWhatAndUntilWhen) {
  const std::string text = annotated_table(counts(), LoopLinks::pages(), {}).html;
  EXPECT_THAT(text, AllOf(HasSubstr("<a href=\"/loop?name=FIC101\"><bdi>FIC101</bdi></a>"),
                          HasSubstr("<span class=\"verdict valve_stiction\">Valve stiction</span>"),
                          HasSubstr(">Acknowledged</td>"),
                          HasSubstr("<bdi>&lt;J. Doe&gt; (login ls)</bdi>"),
                          HasSubstr(">2026-03-01 12:00 UTC</td>"), HasSubstr(">work is entered<"),
                          HasSubstr("<bdi>order 4711</bdi>")));
  EXPECT_THAT(text, AllOf(HasSubstr(">Suppressed</td>"), HasSubstr(">2026-03-01 13:00 UTC</td>"),
                          HasSubstr(">Marked as a false positive</td>"), HasSubstr(">withdrawn<")));
  EXPECT_THAT(text, Not(HasSubstr("older than these")));
  EXPECT_EQ(unbalanced(text), "");
}

TEST(AnnotatedTable, WhatIsNotShownIsCounted) {
  storage::PlantCounts many = counts();
  many.annotations = 43;
  EXPECT_THAT(annotated_table(many, LoopLinks::sections({1, 2}), {}).html,
              AllOf(HasSubstr("40 more, older than these: view hidden_loop. An acknowledged"),
                    Not(HasSubstr("href"))));
  EXPECT_EQ(annotated_table({}, LoopLinks::pages(), {}).html, "");
}

}  // namespace
}  // namespace loopscope::daemon
