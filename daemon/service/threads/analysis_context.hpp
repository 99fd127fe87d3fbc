#pragma once

#include "daemon/service/threads/core_gate.hpp"
#include "daemon/service/threads/progress_board.hpp"

namespace loopscope::daemon {

/// Where a lane does its work: the cores that it shares and the desk that shows its progress.
struct AnalysisContext {
  CoreGate& cores;
  ProgressBoard::Entry& desk;
};

/// Waits for a core, shown as waiting.
[[nodiscard]] inline CoreGate::Permit take_core(const AnalysisContext& place) {
  const ProgressBoard::Entry::Wait wait(place.desk);
  return CoreGate::Permit(place.cores);
}

}  // namespace loopscope::daemon
