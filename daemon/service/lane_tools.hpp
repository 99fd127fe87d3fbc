#pragma once

#include <cstddef>

#include "daemon/service/core_gate.hpp"
#include "daemon/service/fault_log.hpp"
#include "daemon/service/historian_pool.hpp"

namespace loopscope::daemon {

/// What all lanes of the process share. Thread-safe.
struct LaneTools {
  explicit LaneTools(std::size_t workers) : cores(workers) {}
  FaultLog faults;
  HistorianPool historians;
  CoreGate cores;
};

}  // namespace loopscope::daemon
