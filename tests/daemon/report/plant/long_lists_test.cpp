#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/report/page/page_frame.hpp"
#include "daemon/report/plant/event_list.hpp"
#include "daemon/report/plant/plant_section.hpp"
#include "tests/daemon/report/event_rows.hpp"
#include "tests/daemon/report/markup.hpp"
#include "tests/daemon/report/sample_rows.hpp"
#include "tests/support/hostile_names.hpp"

/// The first screen of a plant of thousands of loops.
namespace loopscope::daemon {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr std::int64_t kFlagged = 2000;

/// Every list is long, and every name as long as people make them.
PlantFacts crowded(const std::string& text = "Reflux flow to the second column",
                   std::int64_t flagged = kFlagged) {
  PlantFacts facts = plant_facts(text);
  facts.flagged.clear();
  for (std::int64_t k = 1; k <= flagged; ++k) {
    storage::FlaggedRow row = flagged_row(k, text + std::to_string(k));
    row.code = k % 2 == 0 ? "valve_stiction" : "tight_tuning";
    row.area = text;
    row.unit = "U1";
    row.description = text;
    facts.flagged.push_back(row);
  }
  for (std::int64_t k = 0; k < 5 * flagged / 2; ++k) {
    storage::LoopRow loop;
    loop.enabled = true;
    const std::string area = text + std::to_string(k % 20);
    loop.area_place = k % 20 + 1;
    loop.area = area;
    if (k < flagged) loop.rank = k + 1;
    facts.loops.push_back(loop);
  }
  facts.oscillations.assign(12, sample_event(static_cast<std::size_t>(flagged / 5)));
  for (std::int64_t k = 0; k < flagged / 4; ++k) {
    facts.repairs.push_back(facts.repairs.front());
    facts.counts.without_controller.push_back(facts.counts.without_controller.front());
  }
  return facts;
}

TEST(LongLists, TheLivePageStaysSmallWithItsWorkListFirst) {
  const std::string text = page({}, {plant_section(crowded(), LoopLinks::pages())});
  EXPECT_LT(text.size(), 200'000U);
}

TEST(LongLists, EachKindOfFaultHasItsActionOnce) {
  const std::string words = words_of(plant_section(crowded(), LoopLinks::pages()).html);
  EXPECT_THAT(words, AllOf(HasSubstr("The first 50 of 2000: all flagged loops"),
                           HasSubstr("Tight tuning | 1000 | 1000 | "),
                           HasSubstr("Valve stiction | 1000 | 1000 | Check in the field")));
  EXPECT_THAT(words, HasSubstr("476 more loops without a controller (view service_factor)"));
  EXPECT_THAT(words, HasSubstr("Before these 476 repairs more"));
}

TEST(LongLists, AReportHasATableOfContents) {
  const std::string words = words_of(plant_section(crowded("north"), LoopLinks::sections({})).html);
  EXPECT_THAT(words,
              HasSubstr("Work list 2000 What to do Areas 20 Plant-wide oscillations 12 Taken "
                        "off the list 7 Repairs 501 Without a controller 501 Cannot be "
                        "judged 1 north0 100 north1 100"));
}

TEST(LongLists, AreasLeadToTheirLoops) {
  const std::string text = plant_section(crowded("north"), LoopLinks::pages()).html;
  EXPECT_THAT(text, HasSubstr("<a href=\"/loops?area=north7\"><bdi>north7</bdi></a>"));
  EXPECT_THAT(words_of(text), HasSubstr("north7 | 250 | 100 | 8"));
  PlantFacts nowhere = crowded();
  nowhere.loops = without_areas(nowhere.loops);
  EXPECT_THAT(words_of(plant_section(nowhere, LoopLinks::pages()).html), Not(HasSubstr("By area")));
}

TEST(LongLists, AnOscillationIsALineThatLeadsToItsPage) {
  const std::string text = event_list(std::vector{sample_event(430)}).html;
  EXPECT_THAT(text, HasSubstr("href=\"/oscillation?number=1\""));
  EXPECT_THAT(words_of(text), HasSubstr("1 | 40 s | 430 | L1 (75 %) | "));
  storage::PlantOscillationRow outside = sample_event(3);
  outside.outside = 0.9;
  EXPECT_EQ(source_words(outside), "outside of the recorded loops (90 %)");
  outside.outside.reset();
  outside.source_name = "FIC1";
  EXPECT_EQ(source_words(outside), "FIC1") << "of a program that weighed no outside";
}

TEST(LongLists, NoHostileNameChangesTheMarkup) {
  const auto with = [](const std::string& name) {
    PlantFacts facts = crowded(name, 104);
    for (auto& event : facts.oscillations) event.statement = event.members[0].loop_name = name;
    return tags_of(plant_section(facts, LoopLinks::pages()).html);
  };
  const std::vector<std::string> plain = with("words");
  for (const auto& [about, name] : tests::hostile_names()) EXPECT_EQ(with(name), plain) << about;
}

}  // namespace
}  // namespace loopscope::daemon
