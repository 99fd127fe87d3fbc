#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "core/signal/grid.hpp"
#include "storage/array_literal.hpp"
#include "storage/loop_work.hpp"

namespace loopscope::storage {

/// Columns of loopscope.analysis about the controller: whether one acted; and about what one window
/// tells the next of pv. Every loop has a record.
inline constexpr const char* kNotControlled = "no controller acted for most of the window";

/// A window without a controller shows no loop.
inline bool is_controlled(const CompletedLoop& loop) {
  return loop.record->diagnosis.verdict.code != core::diagnosis::VerdictCode::not_controlling;
}

inline void add_doubt(ArrayLiteral& array, const CompletedLoop& loop) {
  const std::string& doubt = loop.record->diagnosis.evidence.op_range_doubt;
  doubt.empty() ? array.add_null() : array.add_text(doubt);
}

inline void add_lost_by(ArrayLiteral& array, const CompletedLoop& loop) {
  switch (loop.record->diagnosis.evidence.control.reason) {
    case core::signal::NotActing::none:
      return array.add_null();
    case core::signal::NotActing::mode:
      return array.add_text("mode");
    case core::signal::NotActing::constant_output:
      return array.add_text("constant_output");
  }
}

inline void add_lost_at(ArrayLiteral& array, const CompletedLoop& loop) {
  const std::optional<std::size_t>& sample = loop.record->diagnosis.evidence.control.lost_at;
  if (!sample) return array.add_null();
  const core::signal::Grid grid{loop.record->window_start_us, loop.record->sample_interval_s,
                                loop.record->samples};
  array.add_time(grid.time_us(*sample));
}

inline void add_past_pv_flat(ArrayLiteral& array, const CompletedLoop& loop) {
  const std::optional<core::signal::PvPast>& past = loop.record->pv_past;
  past ? array.add_number(past->longest_flat_s) : array.add_null();
}

/// NULL where it is not known.
inline void add_step(ArrayLiteral& array, double step) {
  step > 0.0 ? array.add_number(step) : array.add_null();
}

inline void add_past_pv_step(ArrayLiteral& array, const CompletedLoop& loop) {
  add_step(array, loop.record->pv_past.value_or(core::signal::PvPast{}).step);
}

inline void add_pv_step(ArrayLiteral& array, const CompletedLoop& loop) {
  add_step(array, loop.record->diagnosis.evidence.pv_past.step);
}

}  // namespace loopscope::storage
