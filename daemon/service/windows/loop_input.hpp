#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/diagnosis/diagnose.hpp"
#include "core/signal/loop_window.hpp"
#include "daemon/service/threads/analysis_context.hpp"
#include "daemon/service/windows/window_reader.hpp"
#include "storage/historian/historian_reader.hpp"

namespace loopscope::daemon {

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
