#include "daemon/catalogue/propose_entry.hpp"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/catalogue/loop_type_of.hpp"

namespace loopscope::daemon {
namespace {

using core::signal::OpRange;
using core::signal::Samples;
using storage::CatalogueEntry;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

Samples wave(double low, double high) {
  Samples values;
  for (int k = 0; k < 300; ++k)
    values.push_back(0.5 * (low + high) + 0.5 * (high - low) * std::sin(0.37 * k));
  return values;
}

CatalogueEntry loop_named(const std::string& name) {
  CatalogueEntry entry;
  entry.name = name;
  return entry;
}

/// Of a loop whose name says nothing, and whose pv nobody asks about.
std::vector<Proposal> about_op(const Samples& op, std::optional<OpRange> set = std::nullopt) {
  CatalogueEntry entry = loop_named("loop");
  entry.op_range = set;
  return propose(entry, {{}, op});
}

TEST(ProposeEntry, ARangeThatHistoryMakesClear) {
  for (const auto& [low, high, fields] :
       {std::tuple{0.4, 0.6, "op_low=0 op_high=1"}, std::tuple{4.1, 19.8, "op_low=4 op_high=20"},
        std::tuple{20.0, 80.0, "op_low=0 op_high=100"}}) {
    const auto proposals = about_op(wave(low, high));
    ASSERT_THAT(proposals, SizeIs(1));
    EXPECT_EQ(proposals[0].fields, fields);
    EXPECT_THAT(proposals[0].reason, HasSubstr("in 300 values"));
    CatalogueEntry entry;
    fill_in(proposals, entry);
    EXPECT_TRUE(entry.op_range);
  }
}

TEST(ProposeEntry, WhatIsNotClearIsAsked) {
  const auto either = about_op(wave(8.0, 14.0));
  ASSERT_THAT(either, SizeIs(1));
  EXPECT_EQ(either[0].reason,
            "op is 8.01428 to 14 in 300 values: 0 to 100 (%) or 4 to 20 (mA) or 3 to 15 (psi)?");
  EXPECT_THAT(either[0].answers, ElementsAre("--op-low=0 --op-high=100", "--op-low=4 --op-high=20",
                                             "--op-low=3 --op-high=15"));
  EXPECT_FALSE(either[0].apply);
  EXPECT_THAT(about_op(wave(3.1, 14.8))[0].reason, HasSubstr("0 to 100 (%) or 3 to 15 (psi)?"));
  EXPECT_THAT(about_op(wave(1.9, 3.1))[0].reason, HasSubstr("0 to 100 (%) or 1 to 5 (V)?"));
  EXPECT_TRUE(about_op(wave(1.9, 21.0))[0].apply);
  EXPECT_FALSE(about_op(wave(310.5, 480.5))[0].apply);
  EXPECT_EQ(about_op(wave(-5000.0, 480.5))[0].reason,
            "op is -4986.96 to 480.493 in 300 values: no usual range; which is it?");
  EXPECT_THAT(about_op(Samples(300, 0.0)), IsEmpty()) << "a closed valve says nothing";
}

TEST(ProposeEntry, WhatAPersonHasSetIsDoubtedAndNotReplaced) {
  EXPECT_THAT(about_op(wave(20.0, 80.0), OpRange{}), IsEmpty());
  const auto doubted = about_op(wave(0.2, 0.9), OpRange{});
  ASSERT_THAT(doubted, SizeIs(1));
  EXPECT_EQ(doubted[0].reason, "op never leaves 0 to 1 of 0 to 100: is its range 0 to 1?");
  EXPECT_FALSE(doubted[0].apply);
}

TEST(ProposeEntry, TheRangeOfPvIsAQuestion) {
  const auto proposals = propose(loop_named("loop"), {wave(12.0, 43.0), {}});
  ASSERT_THAT(proposals, SizeIs(1));
  EXPECT_EQ(proposals[0].reason,
            "pv is 12.0738 to 43 in 300 values: is its transmitter's range 0 to 50?");
  EXPECT_THAT(proposals[0].answers, ElementsAre("--pv-low=0 --pv-high=50"));
  EXPECT_FALSE(proposals[0].apply);
}

TEST(ProposeEntry, OneThatPvLeavesIsAQuestionToo) {
  CatalogueEntry entry = loop_named("loop");
  entry.pv_range = OpRange{0.0, 1.0};
  const auto proposals = propose(entry, {wave(12.0, 43.0), {}});
  ASSERT_THAT(proposals, SizeIs(1));
  EXPECT_EQ(
      proposals[0].reason,
      "pv is 12.0738 to 43 in 300 values, not within 0 to 1: is its transmitter's range 0 to 50?");
  EXPECT_FALSE(proposals[0].apply);
  entry.pv_range = OpRange{0.0, 42.0};
  EXPECT_THAT(propose(entry, {wave(12.0, 43.0), {}}), IsEmpty());
}

TEST(ProposeEntry, TheTypeByTheLettersOfTheName) {
  CatalogueEntry entry = loop_named("21FC005");
  fill_in(propose(entry, {}), entry);
  EXPECT_EQ(entry.loop_type, "flow");
  entry.loop_type = "pressure";
  fill_in(propose(entry, {}), entry);
  EXPECT_EQ(entry.loop_type, "pressure");
}

TEST(LoopTypeOf, LettersAfterIsa) {
  EXPECT_EQ(loop_type_of("FIC-101"), "flow");
  EXPECT_EQ(loop_type_of("area1/LIC_3"), "level");
  EXPECT_EQ(loop_type_of("TC7"), "temperature");
  EXPECT_EQ(loop_type_of("PDIC-9"), "pressure");
  EXPECT_EQ(loop_type_of("unit2.fic101"), "flow");
  EXPECT_EQ(loop_type_of("AIC1"), "analysis");
  for (const char* const other : {"FRAC-03", "MA-01", "TI200", "loop", "C101", "PACIFIC1", ""})
    EXPECT_EQ(loop_type_of(other), "") << other;
}

}  // namespace
}  // namespace loopscope::daemon
