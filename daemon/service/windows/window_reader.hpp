#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/diagnosis/diagnose.hpp"
#include "core/signal/loop_window.hpp"
#include "daemon/service/threads/core_gate.hpp"
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

/// A loop whose slow look wants a longer span than its window.
struct SpanRequest {
  const storage::CatalogueEntry* loop = nullptr;
  const LoopWindowAtSlot* at_slot = nullptr;  ///< not empty; gives end and interval
  std::size_t samples = 0;                    ///< of the longer span
};

/// Reads the longer spans of loops of ONE historian, in the order of `requests`, all together.
/// Throws storage::DatabaseError.
[[nodiscard]] std::vector<core::signal::LoopWindow> read_spans(
    storage::HistorianReader& historian, std::span<const SpanRequest> requests, RowMemory& memory);

/// Everything that the analysis of one loop needs from its historian.
struct LoopInput {
  LoopWindowAtSlot at_slot;
  /// nullopt when it threw: core::diagnose() on the window then throws the same, and only this
  /// loop is set aside.
  std::optional<core::FirstLook> first;
  std::optional<core::signal::LoopWindow> long_window;  ///< where the first look asks for it
  double first_look_ms = 0.0;                           ///< part of the analysis' time
};

/// Reads the windows of slots of loops of ONE historian, takes a first look at each, and reads the
/// longer spans that slow oscillations want, all of them in one batch; in the order of `slots`;
/// what `memory` holds is not read again. The looks
/// wait for a core. Throws storage::DatabaseError.
[[nodiscard]] std::vector<LoopInput> read_inputs(storage::HistorianReader& historian,
                                                 std::span<const LoopSlot> slots,
                                                 const core::AnalysisSettings& settings,
                                                 RowMemory& memory, const AnalysisContext& place);

}  // namespace loopscope::daemon
