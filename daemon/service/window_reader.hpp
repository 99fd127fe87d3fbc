#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/signal/loop_window.hpp"
#include "daemon/service/mode_codes.hpp"
#include "daemon/service/slot.hpp"
#include "storage/historian/historian_reader.hpp"
#include "storage/results/results_database.hpp"

namespace loopscope::daemon {

/// What of the settings decides which rows a window is made of.
struct WindowSettings {
  std::size_t max_samples = 4096;
  double settle_s = 60.0;
  SlotRule slot_rule = SlotRule::clock;
  ModeCodes modes;  ///< of the historian that is read
};

/// The window of one claimed loop, ready for analysis.
struct LoopWindowAtSlot {
  std::int64_t slot_end_us = 0;
  core::signal::LoopWindow window;  ///< size 0 when the historian has no row for pv
};

/// Reads the windows of claimed loops of ONE historian: slot, sample interval, rows, grid; in the
/// order of `claims`, in a few round trips whatever their number. Throws storage::DatabaseError.
[[nodiscard]] std::vector<LoopWindowAtSlot> read_windows(
    storage::HistorianReader& historian, std::span<const storage::ClaimedLoop* const> claims,
    const WindowSettings& settings);

/// A loop whose slow look wants a longer span than its window.
struct SpanRequest {
  const storage::CatalogueEntry* loop = nullptr;
  const LoopWindowAtSlot* at_slot = nullptr;  ///< not empty; gives end and interval
  std::size_t samples = 0;                    ///< of the longer span
};

/// Reads the longer spans of loops of ONE historian, in the order of `requests`, all together.
/// Throws storage::DatabaseError.
[[nodiscard]] std::vector<core::signal::LoopWindow> read_spans(
    storage::HistorianReader& historian, std::span<const SpanRequest> requests,
    const ModeCodes& modes);

}  // namespace loopscope::daemon
