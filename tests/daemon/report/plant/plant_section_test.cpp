#include "daemon/report/plant/plant_section.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/daemon/report/markup.hpp"
#include "tests/daemon/report/sample_rows.hpp"
#include "tests/support/hostile_names.hpp"

namespace loopscope::daemon {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(PlantSection, TellsCountsFactorsAndWhatToDo) {
  const std::string text = plant_section(plant_facts("FIC101"), LoopLinks::sections({1, 2})).html;
  EXPECT_THAT(text, HasSubstr("<b>13</b><span>loops</span>"));
  EXPECT_THAT(text, HasSubstr("service factor 93 %"));
  EXPECT_THAT(text, HasSubstr("6 faults not sure enough"));
  EXPECT_THAT(text, HasSubstr("<bdi>TIC9</bdi> and 1 more"));
  EXPECT_THAT(text, HasSubstr("manual, tracking or out of service"));
  EXPECT_THAT(text, HasSubstr("<b>2</b><span>flagged</span>"));
  EXPECT_THAT(text, HasSubstr("Not on the list: 4 loops affected by a shared oscillation, "));
  EXPECT_THAT(text, HasSubstr("marked as false (below), 6 faults not sure"));
  EXPECT_THAT(text, HasSubstr("<h2 id=\"annotated\">Taken off the list by people</h2>"));
  EXPECT_THAT(text, HasSubstr("5 more, older than these"));
  EXPECT_THAT(text, HasSubstr("href=\"#loop-1\""));
  EXPECT_THAT(text, HasSubstr("data-sort=\"0.504\""));
  EXPECT_THAT(text, HasSubstr("2026-03-01 12:00 <span class=\"fresh\">new</span>"));
  PlantFacts first = plant_facts("FIC101");
  first.flagged.resize(1);
  first.flagged[0].or_earlier = true;
  EXPECT_THAT(plant_section(first, LoopLinks::sections({1, 2})).html,
              AllOf(HasSubstr("2026-03-01 12:00 <small>or earlier</small></td>"),
                    Not(HasSubstr("class=\"fresh\""))));
  EXPECT_THAT(text, HasSubstr("Plant-wide oscillation 1: period 2 min, 1 loop"));
  EXPECT_THAT(text, HasSubstr("<span class=\"word improved\">improved</span>"));
  EXPECT_THAT(text, HasSubstr("error std 2 \u2192 1 units of pv (\u00d7 0.5, 0.44 to 0.57)"));
}

TEST(PlantSection, AMemberSwingsAheadOfTheSourceOrBehindIt) {
  PlantFacts facts = plant_facts("FIC101");
  facts.oscillations[0].members.push_back({2, "a", "victim", 0.5, 30.0, 0.1});
  facts.oscillations[0].members.push_back({3, "b", "member", 0.1, -5400.0, 0.1});
  const std::string text = plant_section(facts, LoopLinks::sections({1, 2})).html;
  EXPECT_THAT(text, HasSubstr(">30 s behind</td>"));
  EXPECT_THAT(text, HasSubstr(">90 min ahead</td>"));
  EXPECT_THAT(text, HasSubstr("Found in windows until 2026-03-01 12:00"));
  facts.oscillations[0].source_name.reset();
  EXPECT_THAT(plant_section(facts, LoopLinks::sections({1, 2})).html, Not(HasSubstr("behind")));
}

TEST(PlantSection, WorkThatNothingCanBeSaidOf) {
  PlantFacts facts = plant_facts("FIC101");
  facts.repairs[0].word.reset();
  facts.repairs[0].windows_before = 0;
  EXPECT_THAT(plant_section(facts, LoopLinks::sections({1, 2})).html,
              HasSubstr("unknown\">not judged<"));
  for (const std::optional<std::int64_t> windows : {std::optional<std::int64_t>(2), {}}) {
    facts.repairs[0].windows_before = windows;
    EXPECT_THAT(plant_section(facts, LoopLinks::sections({1, 2})).html,
                HasSubstr("unknown\">too early<"));
  }
}

TEST(PlantSection, LinksToPagesByNameWhereTheyAreLive) {
  EXPECT_THAT(plant_section(plant_facts("a b&c"), LoopLinks::pages()).html,
              HasSubstr("href=\"/loop?name=a%20b%26c\""));
}

TEST(PlantSection, APlantWithoutFlagsSaysSo) {
  const std::string text = plant_section({}, LoopLinks::sections({1, 2})).html;
  EXPECT_THAT(text, HasSubstr("nothing to act on"));
  EXPECT_THAT(text, Not(HasSubstr("<table")));
  EXPECT_EQ(unbalanced(text), "");
}

TEST(PlantSection, NoHostileNameChangesTheMarkup) {
  const std::string plain = plant_section(plant_facts("FIC101"), LoopLinks::pages()).html;
  for (const auto& [about, name] : tests::hostile_names()) {
    const std::string text = plant_section(plant_facts(name), LoopLinks::pages()).html;
    EXPECT_EQ(tags_of(text), tags_of(plain)) << about << ": " << name;
  }
}

}  // namespace
}  // namespace loopscope::daemon
