#include "daemon/output/standard_output.hpp"

#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

TEST(StandardOutput, ATerminalIsSteeredByNoName) {
  EXPECT_EQ(lines_for_terminal("a,\x1b[31mred\nb,\tc\n"), "a,\\x1b[31mred\nb,\\x09c\n");
  EXPECT_EQ(lines_for_terminal("no break"), "no break");
  EXPECT_EQ(lines_for_terminal("\n\n"), "\n\n");
  EXPECT_EQ(lines_for_terminal(""), "");
}

TEST(StandardOutput, WhatIsNoTerminalGetsTheBytes) {
  testing::internal::CaptureStdout();
  write_to_standard_output("a,\x1b[31mred\n");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "a,\x1b[31mred\n");
}

}  // namespace
}  // namespace loopscope::daemon
