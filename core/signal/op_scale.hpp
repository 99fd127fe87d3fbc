#pragma once

#include <optional>
#include <span>

#include "core/signal/op_range.hpp"

namespace loopscope::core::signal {

/// op or mv in percent of `range`; unchanged without one.
[[nodiscard]] Samples to_percent(Samples samples, const std::optional<OpRange>& range);

/// Whether `percent` is within half a percent of an end: controllers stop a little before their
/// limits and converters add noise, and the valve is as good as at its stop.
[[nodiscard]] bool at_end(double percent);

/// Share of the recorded samples at an end, 0 to 1; nullopt when nothing is recorded.
[[nodiscard]] std::optional<double> fraction_at_limit(std::span<const double> percent);

/// The same where the ends were inferred: only what is held there under a lasting error counts,
/// three or more values in a row that are all the largest, or smallest, while the error keeps its
/// sign. `error` as long as `percent`.
[[nodiscard]] std::optional<double> fraction_held_at_limit(std::span<const double> percent,
                                                           std::span<const double> error);

}  // namespace loopscope::core::signal
