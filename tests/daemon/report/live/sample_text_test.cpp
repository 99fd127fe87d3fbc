#include "daemon/report/live/sample_text.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <string_view>
#include <vector>

namespace loopscope::daemon {
namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

/// The bytes of a string of base64, quotes included; a reader of its own.
std::vector<unsigned char> bytes_of(std::string_view text) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<unsigned char> bytes;
  std::uint32_t bits = 0;
  int known = 0;
  for (const char letter : text.substr(1, text.find_first_of("=\"", 1) - 1)) {
    bits = bits << 6 | static_cast<std::uint32_t>(kDigits.find(letter));
    known += 6;
    if (known < 8) continue;
    known -= 8;
    bytes.push_back(static_cast<unsigned char>(bits >> known & 255));
  }
  return bytes;
}

float single_at(const std::vector<unsigned char>& bytes, std::size_t k) {
  std::uint32_t bits = 0;
  for (std::size_t b = 4; b-- > 0;) bits = bits << 8 | bytes.at(4 * k + b);
  return std::bit_cast<float>(bits);
}

std::vector<double> pressures(std::size_t samples) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> value(1013.25, 0.5);
  std::vector<double> values(samples);
  for (double& one : values) one = value(random);
  return values;
}

TEST(SampleText, ValuesThatRestAreRuns) {
  std::vector<double> values(10, 40.33);
  values[7] = kGap;
  values[9] = -1e-9;
  EXPECT_EQ(sample_text(values), "[7,40.33,1,null,1,40.33,1,-1e-09]");
  EXPECT_EQ(sample_text(std::vector(4096, 50.0)), "[4096,50]");
}

TEST(SampleText, ValuesThatMoveAreEachOfThemInSinglePrecision) {
  std::vector<double> values = pressures(301);
  values[7] = kGap;
  const std::string text = sample_text(values);
  EXPECT_EQ(text.front(), '"');
  const auto bytes = bytes_of(text);
  ASSERT_EQ(bytes.size(), 4 * values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (k == 7)
      EXPECT_TRUE(std::isnan(single_at(bytes, k)));
    else
      EXPECT_EQ(single_at(bytes, k), static_cast<float>(values[k]));
  }
}

TEST(SampleText, WhatIsTooLargeIsTheLargestNumber) {
  std::vector<double> values(30, 1e300);
  values[10] = -1e300;
  values[20] = HUGE_VAL;
  EXPECT_EQ(sample_text(values),
            "[10,3.4028235e+38,1,-3.4028235e+38,9,3.4028235e+38,1,null,9,3.4028235e+38]");
}

TEST(SampleText, HoldsNothingThatCouldEndAnElement) {
  std::vector<double> values = pressures(4096);
  values[0] = kGap;
  for (const std::string& text : {sample_text(values), presence_text(values),
                                  sample_text(std::vector{kGap, 1e-300, -0.0, HUGE_VAL})})
    EXPECT_EQ(text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
                                     "0123456789+/=\"[],.-"),
              std::string::npos);
}

TEST(SampleText, PresenceIsABitForEachSample) {
  const auto bytes =
      bytes_of(presence_text(std::vector{1.0, kGap, 3.0, kGap, kGap, kGap, kGap, 8.0, kGap, 10.0}));
  EXPECT_EQ(bytes, (std::vector<unsigned char>{0b1000'0101, 0b10}));
}

}  // namespace
}  // namespace loopscope::daemon
