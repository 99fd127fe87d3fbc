#include "storage/utf8.hpp"

#include <gtest/gtest.h>

namespace loopscope::storage {
namespace {

using namespace std::string_literals;

TEST(Utf8, ValidTextStaysAsItIs) {
  // The smallest and largest character of each length.
  for (const std::string& text :
       {""s, "\x01"s, "\x7F"s, "\xC2\x80"s, "\xDF\xBF"s, "\xE0\xA0\x80"s, "\xED\x9F\xBF"s,
        "\xEF\xBF\xBF"s, "\xF0\x90\x80\x80"s, "\xF4\x8F\xBF\xBF"s, "Füllstand 20 °C"s}) {
    EXPECT_TRUE(is_storable(text));
    EXPECT_EQ(make_storable(text), text);
  }
}

TEST(Utf8, WhatPostgresRefusesIsReplacedByteByByte) {
  const std::string bad = "\xEF\xBF\xBD";
  EXPECT_EQ(make_storable("a\0b"s), "a" + bad + "b");
  EXPECT_EQ(make_storable("\x80"), bad) << "continuation without a lead";
  EXPECT_EQ(make_storable("\xC3"), bad) << "cut off";
  EXPECT_EQ(make_storable("\xC3("), bad + "(");
  EXPECT_EQ(make_storable("\xC0\xAF"), bad + bad) << "overlong";
  EXPECT_EQ(make_storable("\xE0\x9F\xBF"), bad + bad + bad) << "overlong";
  EXPECT_EQ(make_storable("\xED\xA0\x80"), bad + bad + bad) << "surrogate";
  EXPECT_EQ(make_storable("\xF4\x90\x80\x80"), bad + bad + bad + bad) << "above U+10FFFF";
  EXPECT_EQ(make_storable("\xE2\x82x"), bad + bad + "x");
  EXPECT_FALSE(is_storable("a\0b"s));
}

}  // namespace
}  // namespace loopscope::storage
