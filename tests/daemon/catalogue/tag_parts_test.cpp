#include "daemon/catalogue/tag_parts.hpp"

#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

const PlainWords kSomeWords{"pv", "sp", "op", "cv", "out", "spwrk", "spop", "pvin", "processvalue"};

/// "stem word behind", "-" when there is no role.
std::string parts(const std::string& tag) {
  const auto found = split_tag(tag, kSomeWords);
  return found ? found->stem + " " + found->word + " " + found->behind : "-";
}

TEST(TagParts, TheWholeLastPartOrWhatStandsBehindASoftMark) {
  EXPECT_EQ(parts("Area1/FIC101.PV"), "Area1/FIC101 pv .{}");
  EXPECT_EQ(parts("FIC101.SP_OP"), "FIC101 spop .{}") << "one word, not OP of FIC101.SP";
  EXPECT_EQ(parts("FIC_101_SP_WRK"), "FIC_101 spwrk _{}");
  EXPECT_EQ(parts("FIC101 Process Value"), "FIC101 processvalue  {}");
  EXPECT_EQ(parts("FIC101PV"), "FIC101 pv {}");
  EXPECT_EQ(parts("P1.FIC101A_PV"), "P1.FIC101A pv _{}");
}

TEST(TagParts, EndingsThatStandForTheValue) {
  EXPECT_EQ(parts("FIC101/PID.PV#Value"), "FIC101/PID pv .{}#value");
  EXPECT_EQ(parts("FIC101:PV,Value"), "FIC101 pv :{},value");
  EXPECT_EQ(parts("FIC101/PV.CV"), "FIC101 pv /{}.cv");
  EXPECT_EQ(parts("FIC101/CV"), "FIC101 cv /{}") << "no ending: nothing is left before it";
  EXPECT_EQ(parts("N.FIC101_PV.F_CV"), "N.FIC101 pv _{}.f_cv");
  EXPECT_EQ(parts("FIC101_PV_VAL"), "FIC101 pv _{}_val");
  EXPECT_EQ(parts("ns=3;s=\"FIC101\".\"PV\""), "ns=3;s=\"FIC101 pv \".\"{}\"");
  EXPECT_EQ(without_endings("FT-210.Value"), 6u);
}

TEST(TagParts, WhatIsNoRole) {
  for (const char* tag :
       {"", ".", "PV", ".PV", "FIC101.PV.HI", "FIC101.PVHI", "FIC101_SP_H", "FIC101_HI_SP",
        "FIC101.MAN_OP", "FIC101.SP_EXT_OP", "SUPV", "FIC101.PV.EU", "FIC101.PV#ST", "FIC101"})
    EXPECT_EQ(parts(tag), "-") << tag;
}

TEST(TagParts, ALongTagCostsItsLength) {
  for (const char* piece : {"_", ".cv", "_val", "FT1", "x", "1", "\"", "_pv", "1pv"}) {
    std::string tag;
    while (tag.size() < 200'000) tag += piece;
    static_cast<void>(split_tag(tag, kSomeWords));
  }
}

TEST(TagParts, NamesOfNoController) {
  for (const char* path : {"FIC1.HI", "fic1_tot", "FIC1/AI1", "FIC1/AO_2", "TK1.Alarm3", "A.MAX"})
    EXPECT_TRUE(names_no_controller(path)) << path;
  for (const char* path : {"FIC1", "AIC101", "AI-101", "A.L2", "Boiler"})
    EXPECT_FALSE(names_no_controller(path)) << path;
  EXPECT_TRUE(is_controller_block("PIDA"));
  EXPECT_TRUE(is_controller_block("Ctrl_PID"));
  EXPECT_FALSE(is_controller_block("AI1"));
}

}  // namespace
}  // namespace loopscope::daemon
