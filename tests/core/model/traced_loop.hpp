#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/model/traces.hpp"
#include "core/simulate/loop.hpp"

namespace loopscope::core::model::tests {

/// Sums in another order, and pv less its prediction instead of the error itself.
inline constexpr double kRounding = 1e-9;

/// A simulated loop and what trace_explanation() makes of its record.
struct TracedLoop {
  simulate::LoopRecord record;
  std::optional<ExplanationTraces> traces;
};
[[nodiscard]] TracedLoop traced(simulate::LoopRecord record);
[[nodiscard]] TracedLoop traced(std::string_view scenario, std::uint64_t seed = 1);

/// Where in the model an effect entered; 0 = nowhere.
[[nodiscard]] std::size_t stage_of(const ExplanationTraces& traces, EffectKind effect);
/// Of the residual, where it counts.
[[nodiscard]] double mean_square(const TraceStage& stage);

/// What holds whatever is in the record.
void expect_sound(const TracedLoop& loop, const std::string& where);
/// The figures of the explanation are the mean squares of the residuals, but for a share of them.
void expect_figures(const ExplanationTraces& traces, double tolerance, const std::string& where);

}  // namespace loopscope::core::model::tests
