#pragma once

#include <optional>
#include <span>

#include "core/diagnosis/first_look.hpp"
#include "core/signal/loop_window.hpp"
#include "daemon/service/windows/loop_slot.hpp"
#include "daemon/service/windows/row_memory.hpp"
#include "daemon/service/windows/window_reader.hpp"
#include "storage/historian/historian_reader.hpp"

namespace loopscope::daemon {

/// Everything that the analysis of one slot of a loop needs from its historian.
struct LoopInput {
  LoopWindowAtSlot at_slot;
  core::FirstLook first;                                ///< of the window
  std::optional<core::signal::LoopWindow> long_window;  ///< where the first look asks for it
  double prepare_ms = 0.0;                              ///< what the first look took
};

/// The input without the longer span, which nobody can ask for before the first look. Throws what
/// core::first_look() throws.
[[nodiscard]] LoopInput prepare_input(LoopWindowAtSlot at_slot,
                                      const core::AnalysisSettings& settings);

/// An input and whose it is; both have to outlive the call that it is given to.
struct InputOfLoop {
  const storage::CatalogueEntry* loop = nullptr;
  LoopInput* input = nullptr;

  [[nodiscard]] bool wants_longer_span() const { return input->first.slow_span_samples > 0; }
};

/// Reads the longer spans that first looks ask for, of loops of ONE historian, all together; what
/// `memory` holds is not read again. Throws storage::DatabaseError and leaves all as it was.
void read_longer_spans(storage::HistorianReader& historian, std::span<const InputOfLoop> inputs,
                       RowMemory& memory);

/// One slot for somebody who works alone (a report, `replay`): window, first look, longer span.
/// Throws storage::DatabaseError and what core::first_look() throws.
[[nodiscard]] LoopInput read_input(storage::HistorianReader& historian, const LoopSlot& slot,
                                   const core::AnalysisSettings& settings);

}  // namespace loopscope::daemon
