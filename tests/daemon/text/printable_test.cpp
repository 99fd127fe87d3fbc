#include "daemon/text/printable.hpp"

#include <gtest/gtest.h>

#include "tests/support/hostile_names.hpp"

namespace loopscope::daemon {
namespace {

using tests::HostileName;

TEST(Printable, TextStaysAsItIs) {
  for (const char* text : {"", "FIC101.PV", "\\\\PI\\FIC 101", "F\u00fcllstand 20 \u00b0C",
                           "\u6db2\u4f4d \U0001F600", "\u0645\u06cc\u200c\u062e", "'\"$1{}%s"}) {
    EXPECT_EQ(printable(text), text);
  }
}

TEST(Printable, WhatSteersIsShownByItsBytes) {
  EXPECT_EQ(printable("a\nb\r\t"), "a\\x0ab\\x0d\\x09");
  EXPECT_EQ(printable("\x1b[2J"), "\\x1b[2J");
  EXPECT_EQ(printable("\u009b2J"), "\\xc2\\x9b2J");
  EXPECT_EQ(printable("\u202eTXT"), "\\xe2\\x80\\xaeTXT");
  EXPECT_EQ(printable("a\u2028b"), "a\\xe2\\x80\\xa8b");
  EXPECT_EQ(printable("\xff"), "\\xff");
  EXPECT_EQ(printable(std::string("a\0b", 3)), "a\\x00b");
}

TEST(Printable, NoHostileNameSteersATerminalOrBreaksTheLine) {
  for (const auto* names : {&tests::hostile_names(), &tests::impossible_names()}) {
    for (const HostileName& hostile : *names) {
      const std::string shown = printable(hostile.name);
      EXPECT_TRUE(tests::is_harmless_on_a_terminal(shown)) << hostile.about << ": " << shown;
      EXPECT_EQ(shown.find('\n'), std::string::npos) << shown;
      EXPECT_EQ(printable(shown), shown);
    }
  }
}

}  // namespace
}  // namespace loopscope::daemon
