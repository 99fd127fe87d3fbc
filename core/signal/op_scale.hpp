#pragma once

#include <optional>
#include <span>

#include "core/signal/loop_window.hpp"

namespace loopscope::core::signal {

/// The range that turns op into percent: the given one; else 0 to 100 when every recorded value
/// fits into it; else nullopt (op stays in its own units).
[[nodiscard]] std::optional<OpRange> resolve_op_range(std::span<const double> op,
                                                      const std::optional<OpRange>& given);

/// op or mv in percent of `range`; unchanged without one.
[[nodiscard]] Samples to_percent(Samples samples, const std::optional<OpRange>& range);

/// Share of the recorded samples within 0.5 % of 0 or 100 %; nullopt when nothing is recorded.
[[nodiscard]] std::optional<double> fraction_at_limit(std::span<const double> percent);

}  // namespace loopscope::core::signal
