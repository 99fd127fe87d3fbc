#include "daemon/service/windows/loop_input.hpp"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <stdexcept>
#include <utility>

namespace loopscope::daemon {
namespace {

/// Around a setpoint of 0, one sample a second.
LoopWindowAtSlot wave(double period_samples) {
  LoopWindowAtSlot at_slot;
  at_slot.slot_end_us = 4'096'000'000;
  for (std::size_t k = 0; k < 4096; ++k) {
    const double noise = std::sin(std::fmod(static_cast<double>(k * k), 19.0));
    at_slot.window.pv.push_back(std::sin(6.2832 * static_cast<double>(k) / period_samples) +
                                0.1 * noise);
  }
  at_slot.window.sp.assign(4096, 0.0);
  return at_slot;
}

TEST(PrepareInput, KeepsTheWindowAndTakesTheFirstLook) {
  const LoopWindowAtSlot at_slot = wave(40.0);
  const LoopInput input = prepare_input(at_slot, {});
  EXPECT_EQ(input.at_slot.slot_end_us, at_slot.slot_end_us);
  EXPECT_EQ(input.at_slot.window.pv, at_slot.window.pv);
  EXPECT_NEAR(*input.first.period_samples(), 40.0, 1.0);
  EXPECT_FALSE(input.long_window);
}

TEST(PrepareInput, OnlyASlowOscillationWantsALongerSpan) {
  LoopInput fast = prepare_input(wave(40.0), {});
  LoopInput slow = prepare_input(wave(300.0), {});
  EXPECT_FALSE((InputOfLoop{nullptr, &fast}.wants_longer_span()));
  EXPECT_TRUE((InputOfLoop{nullptr, &slow}.wants_longer_span()));
}

TEST(PrepareInput, AWindowThatCannotBePreparedSaysSo) {
  LoopWindowAtSlot at_slot = wave(40.0);
  at_slot.window.sp.pop_back();
  EXPECT_THROW((void)prepare_input(std::move(at_slot), {}), std::invalid_argument);
}

}  // namespace
}  // namespace loopscope::daemon
