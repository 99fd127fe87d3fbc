#include "daemon/report/sections/loop_request.hpp"

#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

TEST(LoopRequest, ReadsWhatAnAddressAsksFor) {
  const auto asked = loop_query({{"q", "FIC 1"},
                                 {"area", "north"},
                                 {"unit", "crude"},
                                 {"verdict", "valve_stiction"},
                                 {"state", "flagged"},
                                 {"order", "confidence"},
                                 {"dir", "desc"},
                                 {"page", "3"}});
  EXPECT_EQ(asked.part, "FIC 1");
  EXPECT_EQ(asked.area, "north");
  EXPECT_EQ(asked.unit, "crude");
  EXPECT_EQ(asked.verdict, "valve_stiction");
  EXPECT_EQ(asked.state, "flagged");
  EXPECT_EQ(asked.order, LoopOrder::confidence);
  EXPECT_TRUE(asked.backwards);
  EXPECT_EQ(asked.most, kLoopsOnPage);
  EXPECT_EQ(asked.skip, 2 * kLoopsOnPage);
}

TEST(LoopRequest, WhatMakesNoSenseIsTheFirstPage) {
  for (const char* page : {"", "0", "-3", "x", "1e9", "99999999999999999999"}) {
    const auto asked = loop_query({{"order", "length"}, {"dir", "up"}, {"page", page}});
    EXPECT_EQ(asked.order, LoopOrder::rank) << page;
    EXPECT_FALSE(asked.backwards) << page;
    EXPECT_EQ(asked.skip, 0) << page;
  }
}

TEST(LoopRequest, OfManyWordsTheFirst) {
  EXPECT_EQ(loop_query({{"q", std::string(8000, 'x')}}).part.size(), 300U);
  std::string umlauts = "x";
  for (int k = 0; k < 400; ++k) umlauts += "\u00fc";
  EXPECT_EQ(loop_query({{"area", umlauts}}).area.size(), 299U) << "whole characters";
}

/// Pages are kept by their address.
TEST(LoopRequest, AddressesSayTheSameAgain) {
  const std::string address = "/loops?q=a%20%26b&area=%22x&order=area&dir=desc&page=2";
  const auto asked = loop_query({{"page", "2"},
                                 {"q", "a &b"},
                                 {"dir", "desc"},
                                 {"order", "area"},
                                 {"area", "\"x"},
                                 {"z", "1"}});
  EXPECT_EQ(loops_address(asked), address);
  EXPECT_EQ(loops_address(loop_query({})), "/loops");
  EXPECT_EQ(loops_address({}), "/loops");
}

}  // namespace
}  // namespace loopscope::daemon
