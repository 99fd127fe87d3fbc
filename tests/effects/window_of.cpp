#include "tests/effects/window_of.hpp"

namespace loopscope::tests::effects {

core::signal::LoopWindow window_of(const Record& record) {
  core::signal::LoopWindow window;
  window.sample_interval_s = record.interval_s;
  window.sp = record.sp;
  window.pv = record.pv;
  window.op = record.op;
  window.op_range = core::signal::OpRange{};
  return window;
}

}  // namespace loopscope::tests::effects
