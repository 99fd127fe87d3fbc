#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "daemon/service/historians/historian_pool.hpp"
#include "daemon/service/observe/fault_log.hpp"
#include "daemon/service/shared/clock_book.hpp"
#include "daemon/service/shared/results_link.hpp"
#include "daemon/service/threads/core_gate.hpp"
#include "daemon/service/threads/progress_board.hpp"
#include "daemon/service/threads/stop_bell.hpp"
#include "storage/results/leases/claim_floor.hpp"

namespace loopscope::daemon {

/// What all lanes of the process share. Thread-safe.
struct LaneTools {
  LaneTools(std::size_t workers, Perseverance how_long);
  /// Whose loops nobody claims just now.
  [[nodiscard]] std::vector<std::string> sources_away();
  StopBell bell;
  Metrics metrics;
  FaultLog faults{metrics};
  HistorianPool historians{metrics};
  CoreGate cores;
  ClockBook clocks;
  ProgressBoard progress;
  const std::shared_ptr<storage::ClaimFloors> floors = std::make_shared<storage::ClaimFloors>();
  /// Held by the one lane that works on a suspect: two that kill their worker cannot be told apart.
  std::mutex suspect_turn;
  const Perseverance perseverance;
};

}  // namespace loopscope::daemon
