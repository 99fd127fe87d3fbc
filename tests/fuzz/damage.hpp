#pragma once

#include "core/signal/loop_window.hpp"
#include "tests/fuzz/byte_source.hpp"

namespace loopscope::tests::fuzz {

/// Takes a few bytes and spoils a stretch of one series of the window: holes, odd values, constant
/// parts, steps, waves, coarse values, huge or tiny scales, another series in its place, modes.
void damage(core::signal::LoopWindow& window, ByteSource& source);

}  // namespace loopscope::tests::fuzz
