#include "daemon/catalogue/match_transmitters.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/catalogue/discover_loops.hpp"
#include "tests/daemon/catalogue/found_loops.hpp"

namespace loopscope::daemon {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Discovery discovered(const std::vector<std::string>& tags) {
  return discover_loops(tags, naming_rules({}, {}, {}));
}

/// "loop role: candidates -> taken".
std::vector<std::string> ambiguities(const Discovery& discovery) {
  std::vector<std::string> all;
  for (const AmbiguousRole& role : discovery.ambiguous) {
    std::string text = role.loop + " " + role.role + ":";
    for (const std::string& tag : role.tags) text += " " + tag;
    all.push_back(text + " -> " + (role.taken.empty() ? "none" : role.taken));
  }
  return all;
}

TEST(MatchTransmitters, OneTransmitterOfTheSameNumberAndPlace) {
  const Discovery found = discovered({"U1/FT-210", "U1/FIC-210.SP", "U1/FIC-210.OP", "LIT_3A.Value",
                                      "LRC_3A.SP", "TE7", "TC7_OP", "PT-9"});
  EXPECT_THAT(found_loops(found),
              ElementsAre("LRC_3A: sp=LRC_3A.SP pv=LIT_3A.Value", "TC7: pv=TE7 op=TC7_OP",
                          "U1/FIC-210: sp=U1/FIC-210.SP pv=U1/FT-210 op=U1/FIC-210.OP"));
  EXPECT_THAT(found.ambiguous, IsEmpty());
  EXPECT_THAT(found.unmatched, ElementsAre("PT-9"));
}

TEST(MatchTransmitters, AControllersOwnPvStays) {
  const Discovery found = discovered({"FT-1", "FIC-1.PV", "FIC-1.SP", "FT-1.PV"});
  EXPECT_THAT(found_loops(found), ElementsAre("FIC-1: sp=FIC-1.SP pv=FIC-1.PV"));
  EXPECT_EQ(found.indicators.at(0).pv_tag, "FT-1.PV");
}

TEST(MatchTransmitters, TheTransmitterBeforeTheIndicatorAndSaid) {
  const Discovery found = discovered({"FT-1", "FI-1.PV", "FIC-1.SP", "TI-2.PV", "TIC-2.SP"});
  EXPECT_THAT(found_loops(found),
              ElementsAre("FIC-1: sp=FIC-1.SP pv=FT-1", "TIC-2: sp=TIC-2.SP pv=TI-2.PV"));
  EXPECT_THAT(ambiguities(found), ElementsAre("FIC-1 pv: FT-1 FI-1.PV -> FT-1"));
}

TEST(MatchTransmitters, WhatIsNotCertainIsNotTaken) {
  const Discovery found = discovered({
      "FT-1A", "FT-1B", "FIC-1.SP",                                  // another suffix
      "TT-2", "TT-2.PV", "TIC-2.SP",                                 // two of one name
      "PT-3", "PIC-3.SP", "PRC-3.SP",                                // two controllers
      "field/LT-4", "board/LIC-4.SP",                                // another place
      "FT-5", "FFIC-5.SP", "PDT-6", "PIC-6.SP", "TT-7", "PIC-7.SP",  // another variable
  });
  EXPECT_THAT(found_loops(found), IsEmpty());
  EXPECT_THAT(ambiguities(found),
              ElementsAre("board/LIC-4 pv: field/LT-4 -> none", "FIC-1 pv: FT-1A FT-1B -> none",
                          "PIC-3 pv: PT-3 -> none", "PRC-3 pv: PT-3 -> none",
                          "TIC-2 pv: TT-2 TT-2.PV -> none"));
}

}  // namespace
}  // namespace loopscope::daemon
