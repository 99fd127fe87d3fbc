#include "daemon/monitor/plain_line.hpp"

#include <gtest/gtest.h>
#include <random>

#include "storage/utf8.hpp"

namespace loopscope::daemon {
namespace {

TEST(PlainLine, LeavesOrdinaryTextAlone) {
  EXPECT_EQ(plain_line("historian Werk-Süd \"a\\b\"", 64), "historian Werk-Süd \"a\\b\"");
  EXPECT_EQ(plain_line("", 64), "");
}

TEST(PlainLine, HasNoControlCharacters) {
  using namespace std::string_view_literals;
  EXPECT_EQ(plain_line("a\nREADY=1\r\tb\x1b[31m\x7f"sv, 64), "a READY=1  b [31m ");
  EXPECT_EQ(plain_line("a\0b"sv, 64), "a\uFFFDb");
}

TEST(PlainLine, IsValidUtf8WhateverComes) {
  EXPECT_EQ(plain_line("a\xff\xfe", 64), "a\uFFFD\uFFFD");
  std::mt19937 random(20260101);  // NOLINT: the same bytes in every run
  std::uniform_int_distribution<int> byte(0, 255);
  for (int round = 0; round < 2000; ++round) {
    std::string text;
    for (int i = 0; i < 40; ++i) text += static_cast<char>(byte(random));
    const std::string line = plain_line(text, 30);
    EXPECT_TRUE(storage::is_storable(line));
    EXPECT_LE(line.size(), 30U);
    EXPECT_EQ(line.find('\n'), std::string::npos);
  }
}

TEST(PlainLine, IsCutBetweenCharacters) {
  EXPECT_EQ(plain_line("abcdefgh", 8), "abcdefgh");
  EXPECT_EQ(plain_line("abcdefghi", 8), "abcde...");
  EXPECT_EQ(plain_line("abcdüüüü", 8), "abcd...");
}

}  // namespace
}  // namespace loopscope::daemon
