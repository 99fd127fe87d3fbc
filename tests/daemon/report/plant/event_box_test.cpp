#include "daemon/report/plant/event_box.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/report/text/html_text.hpp"
#include "tests/daemon/report/event_rows.hpp"
#include "tests/daemon/report/markup.hpp"
#include "tests/daemon/report/sample_rows.hpp"
#include "tests/support/hostile_names.hpp"

namespace loopscope::daemon {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string box_of(const storage::PlantOscillationRow& event) {
  return event_box(event, {}, LoopLinks::pages(), {}).html;
}

TEST(EventBox, SaysHowProbableEachSourceIsAndWhatSpeaksForIt) {
  storage::PlantOscillationRow event = sample_event(4);
  event.members[0].reasons = {"It leads.", "Against it: the others lead it."};
  const std::string text = box_of(event);
  EXPECT_THAT(text, HasSubstr("Plant-wide oscillation 1: period 40 s, 4 loops"));
  EXPECT_THAT(text, HasSubstr("<details class=\"cause\" open><summary><span class=\"label\"><bdi>"
                              "L1</bdi>"));
  EXPECT_THAT(text, HasSubstr("<span class=\"share\">75 %</span>"));
  EXPECT_THAT(text, HasSubstr("<p>For</p><ul><li>It leads.</li></ul>"));
  EXPECT_THAT(text, HasSubstr("<p>Against</p><ul><li>The others lead it.</li></ul>"));
  EXPECT_THAT(text, HasSubstr("outside the recorded loops"));
  EXPECT_THAT(text, HasSubstr("<span class=\"share\">13 %</span>"));
  EXPECT_EQ(unbalanced(text), "");
}

TEST(EventBox, TheMostProbableComesFirstTheOutsideToo) {
  storage::PlantOscillationRow event = sample_event(2);
  event.outside = 0.8;
  event.members[0].score = 0.1;
  event.members[1].score = 0.05;
  const std::string text = box_of(event);
  EXPECT_LT(text.find("outside the recorded"), text.find("class=\"label\"><bdi>L1"));
  EXPECT_LT(text.find("class=\"label\"><bdi>L1"), text.find("class=\"label\"><bdi>L2"));
  EXPECT_THAT(text, HasSubstr("open><summary><span class=\"label\"><bdi>L1"));
}

TEST(EventBox, MembersByTheirShareWithRoleLagAndProbability) {
  const std::string text = box_of(sample_event(3));
  EXPECT_THAT(text, HasSubstr("<a href=\"/loop?name=L2\"><bdi>L2</bdi></a>"));
  EXPECT_THAT(text, HasSubstr("data-label=\"Share\">45 %</td>"));
  EXPECT_THAT(text, HasSubstr("data-label=\"Lag\">3 s behind</td>"));
  EXPECT_THAT(text, HasSubstr("data-label=\"Source?\">75 %</td>"));
  EXPECT_THAT(text, Not(HasSubstr("smaller share")));
}

TEST(EventBox, ManyMembersAreNamedBelowTheTable) {
  const std::string text = box_of(sample_event(30));
  EXPECT_THAT(text, HasSubstr("14 loops with a smaller share"));
  EXPECT_THAT(text, HasSubstr("<bdi>L30</bdi>"));
  EXPECT_EQ(unbalanced(text), "");
}

TEST(EventBox, ShowsItsPictures) {
  const std::vector<Picture> pictures = {{"Trends", "words", "<svg/>", 560, 400}};
  const std::string text = event_box(sample_event(3), pictures, LoopLinks::pages(), {}).html;
  EXPECT_THAT(text, HasSubstr("<figcaption>Trends</figcaption>"));
  EXPECT_THAT(text, HasSubstr("<figcaption>Who follows whom</figcaption>"));
}

/// Scores were no probabilities then.
TEST(EventBox, ARoundOfAProgramOfBeforeShowsWhatThereIs) {
  storage::PlantOscillationRow event = sample_event(3);
  event.outside.reset();
  event.leads.clear();
  event.traces.clear();
  event.members[0].score = 3.5;
  const std::string text = box_of(event);
  EXPECT_THAT(text, Not(HasSubstr("probability</h4>")));
  EXPECT_THAT(text, Not(HasSubstr("350 %")));
  EXPECT_THAT(text, Not(HasSubstr("<svg")));
  EXPECT_THAT(text, HasSubstr("<bdi>L3</bdi>"));
  EXPECT_EQ(unbalanced(text), "");
}

TEST(EventBox, AReportLinksToLoopsOfItsListOnly) {
  std::string text = event_box(sample_event(3), {}, LoopLinks::sections({2}), {}).html;
  EXPECT_THAT(text, HasSubstr("<a href=\"#loop-2\">"));
  EXPECT_THAT(text, Not(HasSubstr("href=\"#loop-3\"")));
  EXPECT_THAT(text, Not(HasSubstr("/loop?name=L3")));
  text = event_box(sample_event(3), {}, LoopLinks::sections({2}, "https://pages"), {}).html;
  EXPECT_THAT(text, HasSubstr("<a href=\"https://pages/loop?name=L3\">"));
}

TEST(EventBox, IsFoldedInAReport) {
  EXPECT_THAT(event_box(sample_event(3), {}, LoopLinks::sections({}), {}).html,
              HasSubstr("<details class=\"fold\"><summary>"));
  EXPECT_THAT(event_box(sample_event(3), {}, LoopLinks::pages(), {}).html,
              Not(HasSubstr("class=\"fold\"")));
}

TEST(EventBox, NoHostileNameChangesTheMarkup) {
  const auto box_with = [](const std::string& text) {
    storage::PlantOscillationRow event = sample_event(20);
    event.source_name = event.statement = text;
    for (auto& member : event.members) member.loop_name = member.role = text;
    event.members[0].reasons = {text, "Against it: " + text};
    const std::vector<Picture> pictures = {{text, text, "<svg/>", 560, 400}};
    return event_box(event, pictures, LoopLinks::pages(), {}).html;
  };
  for (const auto& [about, name] : tests::hostile_names()) {
    EXPECT_EQ(tags_of(box_with(name)), tags_of(box_with("words"))) << about << ": " << name;
    EXPECT_THAT(box_with(name), HasSubstr("<b><bdi>" + html(name) + "</bdi></b>")) << about;
  }
}

}  // namespace
}  // namespace loopscope::daemon
