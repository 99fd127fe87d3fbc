#pragma once

#include "core/signal/prepared_loop.hpp"

namespace loopscope::core::signal {

/// Whether the prepared window can carry an analysis, and what is odd about it. Reads everything of
/// `loop` but its `quality`.
///
/// Flags: sp_missing, sp_moving (cascade or ratio), sp_not_followed, pv_spikes, pv_constant,
/// pv_quantised, pv_held, pv_compressed, samples_drawn, pv_frozen_masked, tests_refused, pv_frozen,
/// pv_dead, op_missing, op_constant, op_range_unknown, op_range_inferred, op_range_doubted,
/// manual_mode, repeated_times.
[[nodiscard]] DataQuality judge_quality(const PreparedLoop& loop, const PrepareSettings& settings);

}  // namespace loopscope::core::signal
