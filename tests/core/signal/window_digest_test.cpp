#include "core/signal/window_digest.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace loopscope::core::signal {
namespace {

LoopWindow small_window() {
  LoopWindow window;
  window.pv = {1.0, 2.0, kMissing};
  window.op = {10.0, 11.0, 12.0};
  return window;
}

TEST(WindowDigest, EqualInputEqualDigest) {
  EXPECT_EQ(window_digest(small_window(), "s"), window_digest(small_window(), "s"));
  EXPECT_EQ(window_digest(small_window(), "s").size(), 16U);
}

TEST(WindowDigest, AnyChangeShows) {
  const std::string digest = window_digest(small_window(), "s");
  LoopWindow changed = small_window();
  changed.pv[2] = 0.0;
  EXPECT_NE(window_digest(changed, "s"), digest);
  changed = small_window();
  changed.start_us = 1;
  EXPECT_NE(window_digest(changed, "s"), digest);
  changed = small_window();
  std::swap(changed.sp, changed.op);
  EXPECT_NE(window_digest(changed, "s"), digest);
  changed = small_window();
  changed.op_range = OpRange{0.0, 50.0};
  EXPECT_NE(window_digest(changed, "s"), digest);
  EXPECT_NE(window_digest(small_window(), "t"), digest);
}

TEST(WindowDigest, EveryMissingSampleAndBothZerosCountTheSame) {
  LoopWindow a = small_window();
  LoopWindow b = small_window();
  a.pv[2] = -std::nan("17");
  b.op[0] = -0.0;
  LoopWindow c = small_window();
  c.op[0] = 0.0;
  EXPECT_EQ(window_digest(a, ""), window_digest(small_window(), ""));
  EXPECT_EQ(window_digest(b, ""), window_digest(c, ""));
}

TEST(WindowSeed, GoesByTheSamplesAlone) {
  LoopWindow window;
  for (int k = 0; k < 100; ++k) window.pv.push_back(0.5 * k);
  window.pv[7] = kMissing;
  LoopWindow elsewhere = window;
  elsewhere.start_us = 1'000'000;
  EXPECT_EQ(window_seed(window), window_seed(elsewhere));
  elsewhere.pv[99] += 1e-9;
  EXPECT_NE(window_seed(window), window_seed(elsewhere));
}

}  // namespace
}  // namespace loopscope::core::signal
