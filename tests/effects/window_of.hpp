#pragma once

#include "core/signal/loop_window.hpp"
#include "tests/effects/generator.hpp"

namespace loopscope::tests::effects {

/// What the diagnosis sees of a record: no valve position; op in %.
[[nodiscard]] core::signal::LoopWindow window_of(const Record& record);

}  // namespace loopscope::tests::effects
