#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <vector>

#include "daemon/service/historians/historian_pool.hpp"
#include "daemon/service/observe/fault_log.hpp"
#include "daemon/service/shared/kept_errors.hpp"
#include "daemon/service/shared/known_clocks.hpp"
#include "daemon/service/shared/results_link.hpp"
#include "daemon/service/threads/core_gate.hpp"
#include "daemon/service/threads/progress_board.hpp"
#include "daemon/service/windows/window_cache.hpp"
#include "storage/results/leases/claim_watermark.hpp"

namespace loopscope::daemon {

/// What all workers of the process share. Thread-safe.
struct SharedServices {
  /// `free_cores` (> 0) windows may be analysed at a time.
  SharedServices(std::size_t free_cores, RetryLimit how_long, std::stop_token stop = {});
  /// Whose loops nobody claims just now.
  [[nodiscard]] std::vector<std::string> sources_away();
  /// Requested by whoever decides on the end of the process: nothing new is begun from then on, and
  /// no pause is waited for. The threads of Heartbeat, PlantWatch and ServiceWatch (with its pages
  /// and reports) do not end by it but by the tokens of their own, after the last worker: until
  /// then leases have to be extended and watchers to be answered.
  const std::stop_token stop;
  Metrics metrics;
  FaultLog faults{metrics};
  HistorianPool historians{metrics};
  CoreGate cores;
  KnownClocks clocks;
  WindowCache windows;  ///< keeps nothing until it is given a limit
  ProgressBoard progress;
  KeptErrors errors;
  const std::shared_ptr<storage::ClaimWatermarks> watermarks =
      std::make_shared<storage::ClaimWatermarks>();
  /// Held by the one worker that works on a suspect: two that kill the process cannot be told
  /// apart.
  std::mutex suspect_turn;
  /// While all loops are compared, which takes the most memory of all: what takes much and can wait
  /// does so.
  std::atomic<bool> comparing = false;
  const RetryLimit perseverance;
};

}  // namespace loopscope::daemon
