#include "daemon/report/sections/loop_section.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/report/page/page_frame.hpp"
#include "daemon/report/text/html_text.hpp"
#include "tests/daemon/report/markup.hpp"
#include "tests/daemon/report/sample_rows.hpp"
#include "tests/support/hostile_names.hpp"

namespace loopscope::daemon {
namespace {

using core::model::EffectKind;
using testing::HasSubstr;
using testing::Not;

LoopReport loop_report(const std::string& text) {
  LoopReport told;
  told.row = flagged_row(7, text);
  told.problems = {{"no_rows", "op", text, text, text, told.row.since_us, true}};
  told.repairs = plant_facts(text).repairs;
  told.followed = {1, 120.0, text, "victim", 0.5, told.row.code};
  told.pictures = {{text, text, "<svg width=\"5\"/>", 520, 320}};
  return told;
}

core::model::Explanation explanation() {
  core::model::Explanation told;
  told.excited = true;
  told.noise_floor = 0.05;
  told.baseline = {"one lag", 0.125, {}};
  core::model::Step step;
  step.effect = EffectKind::valve_stiction;
  step.parameters = {{"S", "%", 5.0, 4.5, 5.5}, {"J", "%", 2.0, std::nullopt, std::nullopt}};
  step.law = "kano";
  step.holdout_error_before = 0.125;
  step.holdout_error_after = 0.0625;
  step.evidence = 2540.0;
  step.p = 0.0;
  told.steps = {step};
  return told;
}

TEST(LoopSection, TellsCauseActionEvidenceAndShowsPictures) {
  const std::string text = loop_section(loop_report("FIC101")).html;
  EXPECT_THAT(text, HasSubstr("id=\"loop-7\""));
  EXPECT_THAT(text, HasSubstr("<dt>Cause</dt>"));
  EXPECT_THAT(text, HasSubstr("<dt>Action</dt>"));
  EXPECT_THAT(text, HasSubstr("<dt>Evidence</dt>"));
  EXPECT_THAT(text, HasSubstr("source of plant-wide oscillation 1"));
  EXPECT_THAT(text, HasSubstr("src=\"data:image/svg+xml,%3Csvg%20width='5'/%3E\""));
  EXPECT_EQ(unbalanced(text), "");
}

TEST(LoopSection, PlainSentencesComeFirstAndFiguresBehindAFold) {
  LoopReport told = loop_report("FIC101");
  told.row.reasons = {"It sticks.", "The error is large.", "It oscillates.",
                      "Figures:",   "For: a figure.",      "NGI"};
  EXPECT_THAT(loop_section(told).html,
              HasSubstr("<ul>\n<li>It sticks.</li>\n<li>The error is large.</li>\n<li>It "
                        "oscillates.</li>\n</ul>\n<details class=\"figures\"><summary>Figures"
                        "</summary><ul>\n<li>For: a figure.</li>\n<li>NGI</li>\n"));
  told.row.reasons = {"For: a figure.", "NGI"};
  EXPECT_THAT(loop_section(told).html, HasSubstr("<ul>\n<li>For: a figure.</li>\n<li>NGI</li>\n"))
      << "a row of a program of before";
}

TEST(LoopSection, WithoutPicturesItSaysWhy) {
  LoopReport told = loop_report("FIC101");
  told.pictures.clear();
  told.trouble = "the historian <is> away";
  EXPECT_THAT(loop_section(told).html, HasSubstr("the window: the historian &lt;is&gt; away"));
  EXPECT_THAT(loop_section(told).html, Not(HasSubstr("class=\"pictures\"")));
}

TEST(LoopSection, BesidePicturesOfThePastItSaysWhyTheWindowHasNone) {
  LoopReport told = loop_report("FIC101");
  told.trouble = "the historian is away";
  EXPECT_THAT(loop_section(told).html,
              HasSubstr("No pictures of the window: the historian is away"));
  EXPECT_THAT(loop_section(told).html, HasSubstr("class=\"pictures\""));
}

TEST(LoopSection, AHiddenLoopSaysWhyAndWhatToDoFirst) {
  LoopReport told = loop_report("TIC7");
  EXPECT_THAT(loop_section(told).html, Not(HasSubstr("Not on the list")));
  told.hidden = {
      {"victim", "FIC1 leads", "", 0, std::nullopt, 3, "FIC1"},
      {"victim", "", "", 0, std::nullopt, 4, std::nullopt},
      {"suppressed", "shut <down>", "eve", 0, 86'400'000'000, std::nullopt, std::nullopt}};
  const std::string text = loop_section(told).html;
  EXPECT_THAT(text, HasSubstr("Affected by plant-wide oscillation 3: repair its source "
                              "<bdi>FIC1</bdi> first, then check again."));
  EXPECT_THAT(text, HasSubstr("oscillation 4, whose source is not known."));
  EXPECT_THAT(text, HasSubstr("Suppressed by <bdi>eve</bdi>, 1970-01-01 00:00"));
  EXPECT_THAT(text, HasSubstr("<bdi>shut &lt;down&gt;</bdi>"));
  EXPECT_LT(text.find("Not on the list"), text.find("<dt>Action</dt>"));
  EXPECT_EQ(unbalanced(text), "");
}

TEST(LoopSection, TheTableHasErrorsBeforeAndAfterAndTheFloor) {
  const std::string table = explanation_table(explanation()).html;
  EXPECT_THAT(table, HasSubstr("+ valve stiction"));
  EXPECT_THAT(table, HasSubstr("S 5 % (4.5 to 5.5); J 2 %; law kano"));
  EXPECT_THAT(table, HasSubstr(">0.125</td>"));
  EXPECT_THAT(table, HasSubstr(">0.0625</td>"));
  EXPECT_THAT(table, HasSubstr("&lt; 1e-12"));
  EXPECT_THAT(table, HasSubstr("Noise floor"));
  EXPECT_EQ(unbalanced(table), "");
}

TEST(LoopSection, AModelThatClaimsNothingSaysSo) {
  core::model::Explanation silent;
  silent.excitation = "op hardly moves";
  EXPECT_THAT(explanation_table(silent).html,
              HasSubstr("The process could not be identified. op hardly moves"));
}

TEST(LoopSection, NoHostileNameChangesTheMarkup) {
  const auto plain = tags_of(page({"FIC101", {"FIC101"}}, {loop_section(loop_report("FIC101"))}));
  for (const auto& [about, name] : tests::hostile_names())
    EXPECT_EQ(tags_of(page({name, {name}}, {loop_section(loop_report(name))})), plain)
        << about << ": " << name;
}

/// One whose window was read again, and one that is only shaken: every sentence of theirs.
std::string judged_again(const std::string& text) {
  LoopReport told = loop_report(text);
  LoopEvidence evidence;
  evidence.diagnosis.evidence.model = explanation();
  evidence.diagnosis.evidence.model->process_doubt = text;
  evidence.diagnosis.evidence.model->baseline.description = text;
  evidence.diagnosis.evidence.data_quality.refusals = {text};
  evidence.diagnosis.evidence.data_quality.flags = {text};
  told.row.code = told.row.status = text;
  told.row.reasons = {text, "Figures:", text};
  told.evidence = evidence;
  told.trouble = text;
  LoopReport shaken = loop_report(text);
  shaken.row.code = "healthy";
  shaken.followed->shown_code = "external_disturbance";
  shaken.hidden = {{"probability", text, "", 0, std::nullopt, std::nullopt, std::nullopt},
                   {"victim", text, "", 0, std::nullopt, 3, text},
                   {text, text, text, 0, std::nullopt, std::nullopt, std::nullopt}};
  return loop_section(told).html + loop_section(shaken).html;
}

TEST(LoopSection, NoHostileWordsOfAWindowChangeTheMarkup) {
  const auto plain = tags_of(judged_again("words"));
  for (const auto& [about, name] : tests::hostile_names()) {
    EXPECT_EQ(tags_of(judged_again(name)), plain) << about << ": " << name;
    EXPECT_THAT(judged_again(name), HasSubstr("<li>" + html(name) + "</li>")) << about;
  }
}

TEST(Page, NamesItsStyleAndItsScriptAndNothingElse) {
  const std::string& policy = content_security_policy();
  EXPECT_THAT(policy, HasSubstr("default-src 'none'"));
  EXPECT_THAT(policy, HasSubstr("script-src 'sha256-"));
  EXPECT_EQ(policy.find("unsafe"), std::string::npos);
  const std::string text = page({"t", {"s"}}, {});
  EXPECT_EQ(text.find("http:"), std::string::npos);
  EXPECT_EQ(text.find("https:"), std::string::npos);
  EXPECT_EQ(text.find("style=\""), std::string::npos);
  EXPECT_EQ(text.find("onclick"), std::string::npos);
}

}  // namespace
}  // namespace loopscope::daemon
