#pragma once

#include <cstdint>

#include "core/signal/loop_window.hpp"

namespace loopscope::tests::effects {

/// What the diagnosis sees of a record with sp, pv and op in %: no valve position.
template <typename Record>
[[nodiscard]] core::signal::LoopWindow window_of(const Record& record, double interval_s,
                                                 std::int64_t start_us = 0) {
  core::signal::LoopWindow window;
  window.sample_interval_s = interval_s;
  window.start_us = start_us;
  window.sp = record.sp;
  window.pv = record.pv;
  window.op = record.op;
  window.op_range = core::signal::OpRange{};
  return window;
}

}  // namespace loopscope::tests::effects
