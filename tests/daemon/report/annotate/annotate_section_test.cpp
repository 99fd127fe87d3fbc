#include "daemon/report/annotate/annotate_section.hpp"

#include <gmock/gmock.h>

#include "daemon/report/text/html_text.hpp"
#include "tests/daemon/report/markup.hpp"
#include "tests/support/hostile_names.hpp"

namespace loopscope::daemon {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr std::int64_t kEnteredAtUs = 1'772'366'400'000'000;  // 2026-03-01T12:00:00Z

AnnotateFacts facts_of(const std::string& name = "FIC101") {
  AnnotateFacts facts;
  facts.loop_name = facts.user = facts.trouble = name;
  facts.token = "0123";
  facts.found.emplace();
  facts.found->code = "valve_stiction";
  facts.found->kind_weight = 1.0;
  facts.found->action = facts.found->summary = name;
  facts.in_force = {
      {name, "acknowledged", "valve_stiction", {}, name, name, kEnteredAtUs, name, 7}};
  facts.told = {name};
  facts.typed = {"suppress", name, name, name};
  return facts;
}

TEST(AnnotateSection, TellsTheFindingWhatHoldsAndOffersTheForm) {
  AnnotateFacts told = facts_of();
  told.user = "J. Doe";
  told.typed = {};
  EXPECT_THAT(
      annotate_section(told).html,
      AllOf(HasSubstr("Signed in as <bdi>J. Doe</bdi>"),
            HasSubstr("<span class=\"verdict valve_stiction\">Valve stiction</span>"),
            HasSubstr("data-label=\"Until\">work is entered</td>"),
            HasSubstr("2026-03-01 12:00 UTC"), HasSubstr("name=\"annotation\" value=\"7\""),
            HasSubstr("value=\"acknowledge\" required checked"),
            HasSubstr("<option value=\"valve_stiction\" selected>verdict valve stiction</option>"
                      "<option value=\"any\">whatever the verdict</option>")));
}

TEST(AnnotateSection, WhatIsNoFaultIsNotOffered) {
  AnnotateFacts healthy = facts_of();
  healthy.typed = {};
  healthy.found->kind_weight = 0.0;
  healthy.in_force.clear();
  EXPECT_THAT(annotate_section(healthy).html,
              AllOf(Not(HasSubstr("verdict valve stiction")), Not(HasSubstr("What holds")),
                    HasSubstr("<option value=\"any\" selected>")));
  healthy.found.reset();
  EXPECT_THAT(annotate_section(healthy).html, HasSubstr("never analysed"));
  healthy.away = true;
  EXPECT_THAT(annotate_section(healthy).html,
              AllOf(Not(HasSubstr("never analysed")), HasSubstr("does not answer")));
}

TEST(AnnotateSection, WhatWasTypedStandsThereAgain) {
  EXPECT_THAT(annotate_section(facts_of("<typed>")).html,
              AllOf(HasSubstr("value=\"suppress\" required checked"),
                    HasSubstr("<option value=\"&lt;typed&gt;\" selected>"),
                    HasSubstr("maxlength=\"500\" required value=\"&lt;typed&gt;\"")));
}

TEST(AnnotateSection, NamesAreText) {
  const std::vector<std::string> plain = tags_of(annotate_section(facts_of()).html);
  for (const tests::HostileName& name : tests::hostile_names())
    EXPECT_EQ(tags_of(annotate_section(facts_of(name.name)).html), plain) << name.about;
}

}  // namespace
}  // namespace loopscope::daemon
