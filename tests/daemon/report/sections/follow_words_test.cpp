#include "daemon/report/sections/follow_words.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/report/sections/loop_list.hpp"
#include "tests/daemon/report/sample_rows.hpp"

namespace loopscope::daemon {
namespace {

using testing::HasSubstr;
using testing::Not;

LoopReport healthy_loop_report() {
  LoopReport loop_report;
  loop_report.row = flagged_row(1, "TIC2");
  loop_report.row.rank = 0;
  loop_report.row.code = "healthy";
  loop_report.row.confidence = 0.93;
  loop_report.row.summary = "Nothing is wrong.";
  loop_report.row.action = "Nothing to do.";
  loop_report.row.plant_oscillation_number.reset();
  return loop_report;
}

TEST(FollowWords, AHealthyLoopThatIsShakenIsNotToldToBeLeftAlone) {
  LoopReport loop_report = healthy_loop_report();
  loop_report.followed = {3, 40.0, "FIC1", "victim", 0.62, "external_disturbance"};
  const std::string text = loop_section(loop_report).html;
  EXPECT_THAT(text, HasSubstr("<span class=\"verdict external_disturbance\">External disturbance"));
  EXPECT_THAT(text,
              HasSubstr("62 % of its error follows plant-wide oscillation 3 of <bdi>FIC1</bdi>"
                        " (period 40 s). By itself the loop is sound (healthy, confidence "
                        "0.93): Nothing is wrong."));
  EXPECT_THAT(text, HasSubstr("Repair the source <bdi>FIC1</bdi> first"));
  EXPECT_THAT(text, Not(HasSubstr("Nothing to do.")));
  loop_report.followed->source_name.reset();
  EXPECT_THAT(loop_section(loop_report).html, HasSubstr("whose source is not known"));
}

TEST(FollowWords, ASentenceNamesShareSourceAndPeriod) {
  storage::FollowedRow followed{3, 5400.0, "FIC1", "victim", 0.624, "external_disturbance"};
  EXPECT_EQ(follow_sentence(followed).html,
            "62 % of its error follows plant-wide oscillation 3 of <bdi>FIC1</bdi> (period 90 "
            "min)");
  followed.source_name.reset();
  EXPECT_EQ(follow_sentence(followed).html,
            "62 % of its error follows plant-wide oscillation 3, whose source is not known (period "
            "90 min)");
}

TEST(FollowWords, OneThatIsHardlyTouchedStaysHealthyAndSaysSo) {
  LoopReport loop_report = healthy_loop_report();
  loop_report.followed = {3, 40.0, "FIC1", "member", 0.1, "healthy"};
  const std::string text = loop_section(loop_report).html;
  EXPECT_THAT(text, HasSubstr("<span class=\"verdict healthy\">"));
  EXPECT_THAT(text, HasSubstr("Nothing to do."));
  EXPECT_THAT(text, HasSubstr("<dt>Follows</dt><dd>10 % of its error follows"));
  loop_report.followed.reset();
  EXPECT_THAT(loop_section(loop_report).html, Not(HasSubstr("Follows")));
}

TEST(FollowWords, AStayOnTheListKeepsItsFaultWhateverTheNewestWindowSays) {
  LoopReport loop_report = healthy_loop_report();
  loop_report.row.code = "valve_stiction";
  loop_report.followed = {3, 40.0, "FIC1", "member", 0.1, "healthy"};
  const std::string text = loop_section(loop_report).html;
  EXPECT_THAT(text, HasSubstr("Valve stiction"));
  EXPECT_THAT(text, Not(HasSubstr("By itself the loop is sound")));
}

TEST(FollowWords, TheListOfAllLoopsSaysWhose) {
  storage::LoopRow row;
  row.name = "TIC2";
  row.code = "healthy";
  row.shown_code = "external_disturbance";
  row.follows = "62 % of its error follows the plant-wide oscillation 3 of FIC1 (period 40 s)";
  const std::string text = loop_list({.loops = {row}, .fitting = 1, .all = 1}, {}, {}).html;
  EXPECT_THAT(text, HasSubstr(std::string(*row.follows)));
  EXPECT_THAT(text, HasSubstr(">External disturbance</span>"));
  EXPECT_THAT(text, HasSubstr("<small>by itself healthy</small>"));
}

}  // namespace
}  // namespace loopscope::daemon
