#include "storage/utf8.hpp"

#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <unordered_map>
#include <vector>

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

std::string encoded(std::uint32_t code) {
  const auto byte = [](std::uint32_t bits) { return static_cast<char>(bits); };
  const auto tail = [&](unsigned shift) { return byte(0x80U | ((code >> shift) & 0x3FU)); };
  if (code < 0x80U) return {byte(code)};
  if (code < 0x800U) return {byte(0xC0U | (code >> 6U)), tail(0)};
  if (code < 0x10000U) return {byte(0xE0U | (code >> 12U)), tail(6), tail(0)};
  return {byte(0xF0U | (code >> 18U)), tail(12), tail(6), tail(0)};
}

/// What first_character() is to find, by looking it up among all characters there are.
class AllCharacters {
 public:
  AllCharacters() {
    for (std::uint32_t code = 1; code <= 0x10FFFFU; ++code)
      if (code < 0xD800U || code > 0xDFFFU) codes_.emplace(encoded(code), code);
  }

  [[nodiscard]] Character first_of(const std::string& text) const {
    for (std::size_t length = 1; length <= text.size(); ++length)
      if (const auto found = codes_.find(text.substr(0, length)); found != codes_.end())
        return {length, found->second};
    return {};
  }

 private:
  std::unordered_map<std::string, char32_t> codes_;
};

/// Every text of one to four bytes at which a rule of UTF-8 begins or ends.
TEST(Utf8, FirstCharactersAreThoseOfUnicode) {
  const std::string edges =
      "\x00\x01\x41\x7F\x80\x8F\x90\x9F\xA0\xBF\xC0\xC1\xC2\xDF"
      "\xE0\xE1\xEC\xED\xEE\xEF\xF0\xF1\xF3\xF4\xF5\xFF"s;
  const AllCharacters all;
  std::vector<std::string> texts{""};
  for (std::size_t k = 0; k < texts.size(); ++k) {
    const std::string text = texts[k];
    const Character is = first_character(text), should = all.first_of(text);
    ASSERT_EQ(is.length, should.length) << testing::PrintToString(text);
    ASSERT_EQ(is.code, should.code) << testing::PrintToString(text);
    if (text.size() == 4) continue;
    for (const char byte : edges) texts.push_back(text + byte);
  }
  EXPECT_EQ(texts.size(), 475'255U);
}

TEST(Utf8, CharactersAreCountedNotBytes) {
  EXPECT_EQ(count_characters(""), 0U);
  EXPECT_EQ(count_characters("a\u00fc\u738b\U0001F600"), 4U);
}

}  // namespace
}  // namespace loopscope::storage
