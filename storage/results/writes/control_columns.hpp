#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "core/signal/grid.hpp"
#include "storage/array_literal.hpp"
#include "storage/loop_work.hpp"

namespace loopscope::storage {

/// Columns of loopscope.analysis about the controller: whether one acted. Every loop has a record.
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

}  // namespace loopscope::storage
