#pragma once

#include "core/signal/loop_window.hpp"

namespace loopscope::core::signal {

/// What a swinging door of this half width (pv units, > 0) stores of a record, NaN for what it does
/// not: a sample is stored when the one behind it cannot be reached by a line from the sample
/// stored last that stays within `band` of all between (Bristol 1990). The first and the last
/// sample of every unbroken piece are stored.
[[nodiscard]] Samples swinging_door(const Samples& samples, double band);

}  // namespace loopscope::core::signal
