#include "daemon/service/windows/window_cache.hpp"

#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

constexpr std::int64_t kNow_us = 1'000;

/// A window of about so many bytes that saves so many rows an hour.
KeptWindow window_of(std::size_t bytes, double saved_rows_per_hour, std::int64_t stale_us = 2'000) {
  KeptWindow window;
  window.saved_rows_per_hour = saved_rows_per_hour;
  window.stale_us = stale_us;
  window.tags.push_back({std::string(bytes, 'x')});
  return window;
}

TEST(WindowCache, KeepsNothingWithoutALimit) {
  WindowCache cache;
  EXPECT_TRUE(cache.is_off());
  cache.keep(1, window_of(100, 1e3), kNow_us);
  EXPECT_EQ(cache.find(1), nullptr);
}

TEST(WindowCache, GivesWhatItKeepsAndForgetsIt) {
  WindowCache cache;
  cache.limit(10'000);
  cache.keep(1, window_of(100, 1e3), kNow_us);
  ASSERT_NE(cache.find(1), nullptr);
  EXPECT_EQ(cache.find(2), nullptr);
  EXPECT_EQ(cache.size().loops, 1U);
  cache.forget(1);
  EXPECT_EQ(cache.find(1), nullptr);
  EXPECT_EQ(cache.size().bytes, 0U);
}

// More loops than fit, in a circle: those that have a place keep it and are found every time.
TEST(WindowCache, ACircleOfEqualLoopsHitsAsOftenAsThereIsRoom) {
  WindowCache cache;
  cache.limit(50'000);
  std::size_t hits = 0;
  for (int round = 0; round < 10; ++round) {
    for (std::int64_t loop = 0; loop < 20; ++loop) {
      if (cache.find(loop)) ++hits;
      // Sizes differ a little from slot to slot.
      cache.keep(loop,
                 window_of(5'000 + static_cast<std::size_t>((loop * 7 + round * 3) % 40), 1e3),
                 kNow_us);
    }
  }
  EXPECT_GE(hits, 8U * 9U);
}

TEST(WindowCache, WhatSavesMoreTakesThePlaceOfWhatSavesLess) {
  WindowCache cache;
  cache.limit(20'000);
  for (std::int64_t loop = 0; loop < 3; ++loop) cache.keep(loop, window_of(5'000, 100.0), kNow_us);
  cache.keep(7, window_of(5'000, 105.0), kNow_us);
  EXPECT_EQ(cache.find(7), nullptr);
  EXPECT_FALSE(cache.has_use_for(7, 105.0));
  EXPECT_TRUE(cache.has_use_for(7, 300.0));
  EXPECT_TRUE(cache.has_use_for(8, 1.0));  // nobody knows its size yet
  cache.keep(7, window_of(5'000, 300.0), kNow_us);
  EXPECT_NE(cache.find(7), nullptr);
  EXPECT_EQ(cache.size().loops, 3U);
  EXPECT_LE(cache.size().bytes, 20'000U);
}

TEST(WindowCache, ALargeWindowDropsNobodyWhereItDoesNotFit) {
  WindowCache cache;
  cache.limit(20'000);
  cache.keep(1, window_of(5'000, 1.0), kNow_us);
  cache.keep(2, window_of(5'000, 1e9), kNow_us);
  cache.keep(3, window_of(18'000, 1e6), kNow_us);
  EXPECT_NE(cache.find(1), nullptr);
  EXPECT_EQ(cache.find(3), nullptr);
}

TEST(WindowCache, LoopsThatAreWithOthersMakeRoom) {
  WindowCache cache;
  cache.limit(12'000);
  cache.keep(1, window_of(5'000, 1e6, 500), kNow_us);
  cache.keep(2, window_of(5'000, 1e6), kNow_us);
  cache.keep(3, window_of(5'000, 1.0), kNow_us);
  EXPECT_EQ(cache.find(1), nullptr);
  EXPECT_NE(cache.find(3), nullptr);
}

TEST(WindowCache, ASmallerLimitDropsTheLeastUseful) {
  WindowCache cache;
  cache.limit(20'000);
  cache.keep(1, window_of(5'000, 1.0), kNow_us);
  cache.keep(2, window_of(5'000, 100.0), kNow_us);
  cache.limit(7'000);
  EXPECT_EQ(cache.find(1), nullptr);
  EXPECT_NE(cache.find(2), nullptr);
  cache.limit(0);
  EXPECT_EQ(cache.size().loops, 0U);
}

}  // namespace
}  // namespace loopscope::daemon
