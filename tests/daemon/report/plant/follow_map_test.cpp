#include "daemon/report/plant/follow_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <regex>

#include "tests/daemon/report/event_rows.hpp"
#include "tests/daemon/report/markup.hpp"
#include "tests/support/hostile_names.hpp"

namespace loopscope::daemon {
namespace {

using testing::HasSubstr;

std::ptrdiff_t count(const std::string& text, const std::string& what) {
  const std::regex pattern(what);
  return std::distance(std::sregex_iterator(text.begin(), text.end(), pattern),
                       std::sregex_iterator());
}

TEST(FollowMap, ABoxForEachLoopAndAnArrowFromItsLeader) {
  const std::string map = follow_map(sample_event(5)).html;
  EXPECT_EQ(count(map, "<rect "), 5);
  EXPECT_EQ(count(map, "stroke-width"), 4);
  EXPECT_THAT(map, HasSubstr("1 L1</text>"));
  EXPECT_THAT(map, HasSubstr("affected loop, 12 s behind"));
  EXPECT_EQ(unbalanced(map), "");
}

TEST(FollowMap, TheSourceThenByLag) {
  storage::PlantOscillationRow event = sample_event(3);
  event.members[1].lag_s = 9.0;
  event.members[2].lag_s = -6.0;
  const std::string map = follow_map(event).html;
  EXPECT_LT(map.find("1 L1<"), map.find("3 L3<"));
  EXPECT_LT(map.find("3 L3<"), map.find("2 L2<"));
}

TEST(FollowMap, OnlyWhatLeadsOnBalanceIsDrawn) {
  storage::PlantOscillationRow event = sample_event(2);
  event.leads = {{1, 2, 0.5}, {2, 1, 0.5}};
  EXPECT_EQ(count(follow_map(event).html, "stroke-width"), 0);
  event.leads[1].gain = 0.6;
  EXPECT_EQ(count(follow_map(event).html, "stroke-width"), 1);
}

/// L1 moves L2, which moves L3: that L1 foretells L3 best is because it foretells L2.
TEST(FollowMap, WhatAThirdLoopTellsAsWellIsNoArrow) {
  storage::PlantOscillationRow event = sample_event(3);
  event.leads = {{1, 2, 0.5, 0.4}, {2, 3, 0.3, 0.2}, {1, 3, 0.6, 0.0}};
  const std::string direct = follow_map(event).html;
  for (storage::PlantLead& lead : event.leads) lead.direct = 0.0;
  EXPECT_NE(follow_map(event).html, direct);
  event.leads.pop_back();
  for (storage::PlantLead& lead : event.leads) lead.direct = lead.gain == 0.5 ? 0.4 : 0.2;
  EXPECT_EQ(follow_map(event).html, direct);
}

TEST(FollowMap, TwelveLoopsAtMost) {
  EXPECT_EQ(count(follow_map(sample_event(40)).html, "<rect "), 12);
}

TEST(FollowMap, ARoundOfBeforeHasNone) {
  storage::PlantOscillationRow event = sample_event(3);
  event.leads.clear();
  EXPECT_EQ(follow_map(event).html, "");
}

TEST(FollowMap, LongNamesAreCutBetweenCharacters) {
  storage::PlantOscillationRow event = sample_event(2);
  event.members[1].loop_name = std::string(15, 'x') + "\u00e4\u00f6\u00fc";
  EXPECT_THAT(follow_map(event).html, HasSubstr(std::string(15, 'x') + "\u00e4\u2026</text>"));
}

TEST(FollowMap, NoNameChangesTheMarkup) {
  for (const auto& [about, name] : tests::hostile_names()) {
    storage::PlantOscillationRow event = sample_event(3);
    event.members[2].loop_name = name;
    EXPECT_EQ(tags_of(follow_map(event).html), tags_of(follow_map(sample_event(3)).html)) << about;
  }
}

}  // namespace
}  // namespace loopscope::daemon
