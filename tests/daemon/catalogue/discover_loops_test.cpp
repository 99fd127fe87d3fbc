#include "daemon/catalogue/discover_loops.hpp"

#include <chrono>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/catalogue/discovery_text.hpp"
#include "daemon/text/failure.hpp"
#include "tests/daemon/catalogue/found_loops.hpp"
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

TEST(DiscoverLoops, FindsWhatSitesHaveByItself) {
  EXPECT_THAT(found_loops(of({"FIC101.SP", "FIC101.PV", "FIC101.OP", "FIC101.MODE"})),
              ElementsAre("FIC101: sp=FIC101.SP pv=FIC101.PV op=FIC101.OP mode=FIC101.MODE"));
  EXPECT_THAT(
      found_loops(of({"area1/FIC101/pv", "area1/FIC101/sp", "area2/FIC101/pv", "area2/FIC101/op"})),
      ElementsAre("area1/FIC101: sp=area1/FIC101/sp pv=area1/FIC101/pv",
                  "area2/FIC101: pv=area2/FIC101/pv op=area2/FIC101/op"));
  EXPECT_THAT(found_loops(of({"FIC101_MEAS", "FIC101_OUT", "FIC101_SETPOINT", "FIC101_ZT"})),
              ElementsAre("FIC101: sp=FIC101_SETPOINT pv=FIC101_MEAS op=FIC101_OUT mv=FIC101_ZT"));
  EXPECT_THAT(found_loops(of({"FIC101.PIDA.OP", "FIC101.PIDA.PV", "FIC101.PIDA.SP"})),
              ElementsAre("FIC101: sp=FIC101.PIDA.SP pv=FIC101.PIDA.PV op=FIC101.PIDA.OP"));
  EXPECT_THAT(found_loops(of({"FIC101/PID1/PV.CV", "FIC101/PID1/SP.CV", "FIC101/PID1/OUT.CV",
                              "FIC101/PID1/MODE.ACTUAL"})),
              ElementsAre("FIC101: sp=FIC101/PID1/SP.CV pv=FIC101/PID1/PV.CV "
                          "op=FIC101/PID1/OUT.CV mode=FIC101/PID1/MODE.ACTUAL"));
}

TEST(DiscoverLoops, CaseDoesNotPartALoop) {
  EXPECT_THAT(found_loops(of({"FIC101.PV", "fic101.sp"})),
              ElementsAre("FIC101: sp=fic101.sp pv=FIC101.PV"));
}

TEST(DiscoverLoops, MvIsTheOutputWhereNothingElseIs) {
  const Discovery yokogawa = of({"FIC101.PV", "FIC101.SV", "FIC101.MV"});
  EXPECT_THAT(found_loops(yokogawa), ElementsAre("FIC101: sp=FIC101.SV pv=FIC101.PV op=FIC101.MV"));
  EXPECT_THAT(yokogawa.by_shared_word, ElementsAre("FIC101"));
  EXPECT_THAT(found_loops(of({"FIC101.PV", "FIC101.OP", "FIC101.MV"})),
              ElementsAre("FIC101: pv=FIC101.PV op=FIC101.OP mv=FIC101.MV"));
}

TEST(DiscoverLoops, TwoTagsForOneRoleAreSaid) {
  const Discovery preferred = of({"F.PV", "F.MEAS", "F.SP"});
  EXPECT_THAT(found_loops(preferred), ElementsAre("F: sp=F.SP pv=F.PV"));
  ASSERT_EQ(preferred.ambiguous.size(), 1u);
  EXPECT_EQ(preferred.ambiguous[0].taken, "F.PV");
  const Discovery as_the_others = of({"F.PV", "F/PV", "F.SP"});
  EXPECT_THAT(found_loops(as_the_others), ElementsAre("F: sp=F.SP pv=F.PV"));
  EXPECT_EQ(as_the_others.ambiguous.at(0).taken, "F.PV");
  const Discovery equal = of({"F.PV", "F/PV", "F.SP", "F/SP"});
  EXPECT_THAT(equal.loops, IsEmpty()) << "nothing says which one";
  EXPECT_THAT(equal.ambiguous.at(0).tags, ElementsAre("F.SP", "F/SP"));
  EXPECT_THAT(equal.ambiguous.at(1).tags, ElementsAre("F.PV", "F/PV"));
  EXPECT_EQ(equal.ambiguous[1].taken, "");
  const Discovery equal_words =
      of({"[P]FIC1.PV", "[P]FIC1.SPProg", "[P]FIC1.SPOper", "[P]FIC1.CV"});
  EXPECT_THAT(found_loops(equal_words), ElementsAre("[P]FIC1: pv=[P]FIC1.PV op=[P]FIC1.CV"));
  EXPECT_THAT(equal_words.ambiguous.at(0).tags, ElementsAre("[P]FIC1.SPProg", "[P]FIC1.SPOper"));
}

TEST(DiscoverLoops, WhatIsMissingAndWhatFitsNothing) {
  const Discovery found = of({"A.PV", "A.SP", "B.SP", "B.OP", "TI200", "X.ALARM", "TI-7.PV"});
  EXPECT_THAT(found.unmatched, ElementsAre("TI200", "X.ALARM"));
  EXPECT_EQ(found.without_pv.at(0).name, "B");
  EXPECT_EQ(found.indicators.at(0).name, "TI-7");
  DiscoveryReport report{"plant", 7, found, 0, {}};
  const std::string text = discovery_text(report);
  EXPECT_THAT(text, HasSubstr("plant: 7 tags, 1 loop is new (sp 1, pv 1, op 0, mv 0, mode 0)"));
  EXPECT_THAT(text, HasSubstr("1 without pv, left out: B (B.SP, B.OP)"));
  EXPECT_THAT(text, HasSubstr("1 pv without sp and op, no control loop, left out: TI-7 (TI-7.PV)"));
  EXPECT_THAT(text, HasSubstr("1 without op, no model and no valve to judge: A"));
  EXPECT_THAT(text, HasSubstr("2 tags are no loop's by their names: TI200, X.ALARM"));
}

std::vector<std::string> reasons(const Discovery& discovery) {
  std::vector<std::string> all;
  for (const DoubtfulLoop& loop : discovery.doubtful)
    all.push_back(loop.entry.name + ": " + loop.reason);
  return all;
}

TEST(DiscoverLoops, WhatIsPerhapsNoLoopIsLeftOut) {
  const Discovery found =
      of({"FV-3.PV", "FV-3.SP", "FV-3.OP", "TI-4.PV", "TI-4.SP", "CRANE.X", "CRANE.Y", "BOX7PV",
          "BOX7SP", "R5.X", "R5/W", "R5.Y", "FT-6.PV", "FT-6.SP", "FT-6.OP"});
  EXPECT_THAT(found_loops(found), ElementsAre("FT-6: sp=FT-6.SP pv=FT-6.PV op=FT-6.OP"));
  EXPECT_THAT(reasons(found),
              ElementsAre("BOX7: not sp, pv and op together, and no mark before the word",
                          "CRANE: everyday words, not sp, pv and op together",
                          "FV-3: named as a valve or a relay",
                          "R5: everyday words, not named alike", "TI-4: named as a measurement"));
}

TEST(DiscoverLoops, AModuleWithSeveralControllersIsSeveralLoops) {
  EXPECT_THAT(found_loops(of({"TIC1/PID1/PV.CV", "TIC1/PID1/SP.CV", "TIC1/PID2/PV.CV",
                              "TIC1/PID2/OUT.CV", "PLC1.PID7.PV", "PLC1.PID7.SP"})),
              ElementsAre("PLC1.PID7: sp=PLC1.PID7.SP pv=PLC1.PID7.PV",
                          "TIC1/PID1: sp=TIC1/PID1/SP.CV pv=TIC1/PID1/PV.CV",
                          "TIC1/PID2: pv=TIC1/PID2/PV.CV op=TIC1/PID2/OUT.CV"));
}

TEST(DiscoverLoops, TheControllersOwnNameIsItsPv) {
  EXPECT_THAT(
      found_loops(of({"FIC8", "FIC8.SP", "FIC8.OP", "LIC9.Value", "LIC9.SP", "TANK", "TANK.SP"})),
      ElementsAre("FIC8: sp=FIC8.SP pv=FIC8 op=FIC8.OP", "LIC9: sp=LIC9.SP pv=LIC9.Value"));
}

TEST(DiscoverLoops, OwnPatternsAndWords) {
  const NamingRules rules = naming_rules({}, {"{role}@{loop}"}, {"pv=IST", "SP=SOLL", "op="});
  EXPECT_THAT(found_loops(of({"Ist@R7", "soll@R7", "stell@R7"}, rules)),
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
