#pragma once

#include "daemon/service/threads/core_gate.hpp"
#include "daemon/service/threads/progress_board.hpp"

namespace loopscope::daemon {

/// Where a lane does its work: the cores that it shares and the desk that shows its progress.
struct Workplace {
  CoreGate& cores;
  ProgressBoard::Desk& desk;
};

/// Waits for a core, shown as waiting.
[[nodiscard]] inline CoreGate::Permit take_core(const Workplace& place) {
  const ProgressBoard::Desk::Wait wait(place.desk);
  return CoreGate::Permit(place.cores);
}

}  // namespace loopscope::daemon
