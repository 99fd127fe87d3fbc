#include "core/plant/event_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace loopscope::core::plant {
namespace {

constexpr double kPeriod_s = 50.0;

/// A sine of kPeriod_s, and a slower one of the same size where `drift` says so.
std::vector<double> sine(std::size_t samples, double interval_s, bool drift = false) {
  std::vector<double> error;
  for (std::size_t k = 0; k < samples; ++k) {
    const double turn = 2.0 * std::numbers::pi * static_cast<double>(k) * interval_s / kPeriod_s;
    error.push_back(5.0 + std::sin(turn) + (drift ? std::sin(turn / 10.0) : 0.0));
  }
  return error;
}

MemberLoop loop_of(const std::vector<double>& error, double interval_s, std::int64_t start_us) {
  MemberLoop loop;
  loop.sample_interval_s = interval_s;
  loop.start_us = start_us;
  loop.error = error;
  return loop;
}

double peak_period(const MemberPicture& picture) {
  const auto at = std::ranges::max_element(picture.power) - picture.power.begin();
  return picture.periods_s[static_cast<std::size_t>(at)];
}

TEST(EventPicture, TheLastTwelvePeriodsThatAllHaveOnOneAxis) {
  const std::vector<double> one = sine(4000, 1.0), other = sine(1600, 2.0);
  const std::vector<MemberLoop> loops = {loop_of(one, 1.0, 0), loop_of(other, 2.0, 100'000'000)};
  const auto pictures = picture_event(kPeriod_s, std::array<std::size_t, 2>{1, 0}, loops);
  ASSERT_EQ(pictures.size(), 2U);
  EXPECT_EQ(pictures[0].index, 1U);
  // The second one ends at 100 s + 1599 x 2 s, before the first.
  for (const MemberPicture& picture : pictures) {
    ASSERT_FALSE(picture.error.empty());
    ASSERT_LE(picture.error.size(), kTraceValues);
    const double start_s = static_cast<double>(picture.start_us) / 1e6;
    EXPECT_NEAR(start_s, 3298.0 - 600.0, 2.0 * picture.step_s);
    EXPECT_NEAR(start_s + static_cast<double>(picture.error.size() - 1) * picture.step_s, 3298.0,
                2.0 * picture.step_s);
  }
}

TEST(EventPicture, ValuesAreMeansOfTheErrorAtTheirTimes) {
  const std::vector<double> error = sine(4000, 1.0);
  const std::vector<MemberLoop> loops = {loop_of(error, 1.0, 0)};
  const auto picture = picture_event(kPeriod_s, std::array<std::size_t, 1>{0}, loops).front();
  for (std::size_t k = 0; k + 1 < picture.error.size(); ++k) {
    const double time_s =
        static_cast<double>(picture.start_us) / 1e6 + static_cast<double>(k) * picture.step_s;
    EXPECT_NEAR(picture.error[k], 5.0 + std::sin(2.0 * std::numbers::pi * time_s / kPeriod_s),
                0.01);
  }
}

TEST(EventPicture, TheSpectrumPeaksAtThePeriodAndHoldsTheVariance) {
  std::vector<double> error = sine(4096, 1.0, true);
  for (std::size_t k = 700; k < 710; ++k) error[k] = NAN;
  const std::vector<MemberLoop> loops = {loop_of(error, 1.0, 0)};
  const auto picture = picture_event(kPeriod_s, std::array<std::size_t, 1>{0}, loops).front();
  ASSERT_LE(picture.power.size(), kSpectrumValues);
  ASSERT_GT(picture.power.size(), kSpectrumValues / 2);
  EXPECT_TRUE(std::ranges::is_sorted(picture.periods_s));
  double about = 0.0;
  for (std::size_t k = 1; k < picture.power.size(); ++k)
    if (std::abs(std::log(picture.periods_s[k] / kPeriod_s)) < 0.3)
      about += picture.power[k] * std::log(picture.periods_s[k] / picture.periods_s[k - 1]);
  EXPECT_NEAR(about, 0.5, 0.1) << "half of the variance";
}

TEST(EventPicture, PeaksAtThePeriodWhateverTheSampling) {
  for (const double interval_s : {0.5, 1.0, 4.0, 11.0}) {
    const std::vector<double> error = sine(1000, interval_s);
    const std::vector<MemberLoop> loops = {loop_of(error, interval_s, 0)};
    const auto picture = picture_event(kPeriod_s, std::array<std::size_t, 1>{0}, loops).front();
    EXPECT_NEAR(peak_period(picture) / kPeriod_s, 1.0, 0.1) << interval_s;
  }
}

TEST(EventPicture, WhatIsMissingStaysSo) {
  std::vector<double> error = sine(2000, 1.0);
  for (std::size_t k = 1700; k < 1800; ++k) error[k] = NAN;
  const std::vector<double> never(2000, NAN);
  const std::vector<double> none;
  const std::vector<MemberLoop> loops = {loop_of(error, 1.0, 0), loop_of(never, 1.0, 0),
                                         loop_of(none, 1.0, 0)};
  const auto pictures = picture_event(kPeriod_s, std::array<std::size_t, 3>{0, 1, 2}, loops);
  ASSERT_EQ(pictures.size(), 3U);
  const auto missing = [](double value) { return std::isnan(value); };
  EXPECT_NEAR(static_cast<double>(std::ranges::count_if(pictures[0].error, missing)),
              100.0 / pictures[0].step_s, 2.0);
  EXPECT_TRUE(std::ranges::all_of(pictures[1].error, missing));
  EXPECT_TRUE(pictures[1].power.empty());
  EXPECT_TRUE(pictures[2].error.empty());
}

TEST(EventPicture, EightLoopsAtMost) {
  const std::vector<double> error = sine(1000, 1.0);
  const std::vector<MemberLoop> loops(12, loop_of(error, 1.0, 0));
  const std::vector<std::size_t> members = {3, 1, 2, 0, 4, 5, 6, 7, 8, 9};
  const auto pictures = picture_event(kPeriod_s, members, loops);
  ASSERT_EQ(pictures.size(), kMostPictured);
  EXPECT_EQ(pictures[0].index, 3U);
}

}  // namespace
}  // namespace loopscope::core::plant
