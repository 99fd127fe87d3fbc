#pragma once

#include <cstddef>
#include <mutex>

#include "daemon/service/clock_book.hpp"
#include "daemon/service/core_gate.hpp"
#include "daemon/service/fault_log.hpp"
#include "daemon/service/historian_pool.hpp"
#include "daemon/service/progress_board.hpp"
#include "daemon/service/results_link.hpp"
#include "daemon/service/stop_bell.hpp"

namespace loopscope::daemon {

/// What all lanes of the process share. Thread-safe.
struct LaneTools {
  LaneTools(std::size_t workers, Perseverance how_long);
  StopBell bell;
  Metrics metrics;
  FaultLog faults{metrics};
  HistorianPool historians{metrics};
  CoreGate cores;
  ClockBook clocks;
  ProgressBoard progress;
  /// Held by the one lane that works on a suspect: two that kill their worker cannot be told apart.
  std::mutex suspect_turn;
  const Perseverance perseverance;
};

}  // namespace loopscope::daemon
