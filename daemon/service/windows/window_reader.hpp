#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/signal/loop_window.hpp"
#include "daemon/service/windows/loop_slot.hpp"
#include "daemon/service/windows/row_memory.hpp"
#include "storage/historian/historian_reader.hpp"

namespace loopscope::daemon {

/// The window of one slot of a loop, ready for analysis.
struct LoopWindowAtSlot {
  std::int64_t slot_end_us = 0;
  core::signal::LoopWindow window;  ///< size 0 when the historian has no row for pv
  TagReadings tags;                 ///< one for each tag of the loop
};

/// Reads the windows of slots of loops of ONE historian: sample interval, rows, grid; in the order
/// of `slots`, in a few round trips whatever their number; what `memory` holds is not read again.
/// The same rows give the same window whenever it is read. Throws storage::DatabaseError.
[[nodiscard]] std::vector<LoopWindowAtSlot> read_windows(storage::HistorianReader& historian,
                                                         std::span<const LoopSlot> slots,
                                                         std::size_t max_samples,
                                                         RowMemory& memory);

/// A loop whose first look asks for a longer span than its window.
struct SpanRequest {
  const storage::CatalogueEntry* loop = nullptr;
  const LoopWindowAtSlot* at_slot = nullptr;  ///< not empty; gives end and interval
  std::size_t samples = 0;                    ///< of the longer span
};

/// Reads the longer spans of loops of ONE historian, in the order of `requests`, all together.
/// Throws storage::DatabaseError.
[[nodiscard]] std::vector<core::signal::LoopWindow> read_spans(
    storage::HistorianReader& historian, std::span<const SpanRequest> requests, RowMemory& memory);

}  // namespace loopscope::daemon
