#include "daemon/catalogue/discover_loops.hpp"

#include <chrono>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/catalogue/discovery_text.hpp"
#include "daemon/catalogue/entry_fields.hpp"
#include "daemon/text/failure.hpp"
#include "tests/support/sanitized.hpp"

namespace loopscope::daemon {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

NamingRules defaults() {
  return naming_rules({}, {}, {});
}

Discovery of(const std::vector<std::string>& tags, const NamingRules& rules = defaults()) {
  return discover_loops(tags, rules);
}

/// "name: sp=..., pv=..." of each loop.
std::vector<std::string> texts(const Discovery& discovery) {
  std::vector<std::string> found;
  for (const auto& entry : discovery.loops) {
    std::string text = entry.name + ":";
    for (const TagRole& role : kTagRoles) {
      if (!(entry.*role.tag).empty()) text += " " + std::string(role.name) + "=" + entry.*role.tag;
    }
    found.push_back(text);
  }
  return found;
}

TEST(DiscoverLoops, FindsWhatSitesHaveByItself) {
  EXPECT_THAT(texts(of({"FIC101.SP", "FIC101.PV", "FIC101.OP", "FIC101.MODE"})),
              ElementsAre("FIC101: sp=FIC101.SP pv=FIC101.PV op=FIC101.OP mode=FIC101.MODE"));
  EXPECT_THAT(texts(of({"area1/FIC101/pv", "area1/FIC101/sp", "area2/FIC101/pv"})),
              ElementsAre("area1/FIC101: sp=area1/FIC101/sp pv=area1/FIC101/pv",
                          "area2/FIC101: pv=area2/FIC101/pv"));
  EXPECT_THAT(texts(of({"FIC101_MEAS", "FIC101_OUT", "FIC101_SETPOINT", "FIC101_ZT"})),
              ElementsAre("FIC101: sp=FIC101_SETPOINT pv=FIC101_MEAS op=FIC101_OUT mv=FIC101_ZT"));
  EXPECT_THAT(texts(of({"FIC101.PIDA.OP", "FIC101.PIDA.PV", "FIC101.PIDA.SP"})),
              ElementsAre("FIC101: sp=FIC101.PIDA.SP pv=FIC101.PIDA.PV op=FIC101.PIDA.OP"));
  EXPECT_THAT(texts(of({"FIC101/PID1/PV.CV", "FIC101/PID1/SP.CV", "FIC101/PID1/OUT.CV",
                        "FIC101/PID1/MODE.ACTUAL"})),
              ElementsAre("FIC101: sp=FIC101/PID1/SP.CV pv=FIC101/PID1/PV.CV "
                          "op=FIC101/PID1/OUT.CV mode=FIC101/PID1/MODE.ACTUAL"));
}

TEST(DiscoverLoops, CaseDoesNotPartALoop) {
  EXPECT_THAT(texts(of({"FIC101.PV", "fic101.sp"})),
              ElementsAre("FIC101: sp=fic101.sp pv=FIC101.PV"));
}

TEST(DiscoverLoops, MvIsTheOutputWhereNothingElseIs) {
  const Discovery yokogawa = of({"FIC101.PV", "FIC101.SV", "FIC101.MV"});
  EXPECT_THAT(texts(yokogawa), ElementsAre("FIC101: sp=FIC101.SV pv=FIC101.PV op=FIC101.MV"));
  EXPECT_THAT(yokogawa.by_shared_word, ElementsAre("FIC101"));
  EXPECT_THAT(texts(of({"FIC101.PV", "FIC101.OP", "FIC101.MV"})),
              ElementsAre("FIC101: pv=FIC101.PV op=FIC101.OP mv=FIC101.MV"));
}

TEST(DiscoverLoops, TwoTagsForOneRoleAreSaid) {
  const Discovery preferred = of({"F.PV", "F.MEAS"});
  EXPECT_THAT(texts(preferred), ElementsAre("F: pv=F.PV"));
  ASSERT_EQ(preferred.ambiguous.size(), 1u);
  EXPECT_EQ(preferred.ambiguous[0].taken, "F.PV");
  const Discovery equal = of({"F.PV", "F/PV", "F.SP"});
  EXPECT_THAT(equal.loops, IsEmpty()) << "nothing says which one";
  EXPECT_EQ(equal.without_pv.size(), 1u);
  EXPECT_THAT(equal.ambiguous.at(0).tags, ElementsAre("F.PV", "F/PV"));
  EXPECT_EQ(equal.ambiguous[0].taken, "");
}

TEST(DiscoverLoops, WhatIsMissingAndWhatFitsNothing) {
  const Discovery found = of({"A.PV", "B.SP", "B.OP", "TI200", "X.ALARM"});
  EXPECT_THAT(found.unmatched, ElementsAre("TI200", "X.ALARM"));
  EXPECT_EQ(found.without_pv.at(0).name, "B");
  DiscoveryReport report{"plant", 5, found, 0, {}};
  const std::string text = discovery_text(report);
  EXPECT_THAT(text, HasSubstr("plant: 5 tags, 1 loop is new (sp 0, pv 1, op 0, mv 0, mode 0)"));
  EXPECT_THAT(text, HasSubstr("1 without pv, left out: B (B.SP, B.OP)"));
  EXPECT_THAT(text, HasSubstr("1 without op, no model and no valve to judge: A"));
  EXPECT_THAT(text, HasSubstr("2 tags fit no pattern: TI200, X.ALARM"));
}

TEST(DiscoverLoops, OwnPatternsAndWords) {
  const NamingRules rules = naming_rules({}, {"{role}@{loop}"}, {"pv=IST", "SP=SOLL", "mode="});
  EXPECT_THAT(texts(of({"Ist@R7", "soll@R7", "stell@R7"}, rules)),
              ElementsAre("R7: sp=soll@R7 pv=Ist@R7"));
  EXPECT_THROW(static_cast<void>(naming_rules({}, {"{loop}"}, {})), Failure);
  EXPECT_THROW(static_cast<void>(naming_rules({}, {}, {"pv"})), Failure);
  EXPECT_THROW(static_cast<void>(naming_rules({}, {}, {"flow=F"})), Failure);
}

TEST(DiscoverLoops, TenThousandLoopsInASecond) {
  std::vector<std::string> tags;
  for (int k = 0; k < 10'000; ++k) {
    for (const char* word : {"SP", "PV", "OP", "MODE", "ALARM"}) {
      tags.push_back("area" + std::to_string(k % 7) + "/FIC" + std::to_string(k) + "/" + word);
    }
  }
  const auto start = std::chrono::steady_clock::now();
  const Discovery found = of(tags);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  EXPECT_EQ(found.loops.size(), 10'000u);
  EXPECT_EQ(found.unmatched.size(), 10'000u);
  // Under a sanitizer the room is compiled without optimisation.
  if (!loopscope::tests::kSanitized) {
    EXPECT_LT(took.count(), 5.0) << "half a second on an idle core";
  }
  RecordProperty("seconds", std::to_string(took.count()));
}

}  // namespace
}  // namespace loopscope::daemon
