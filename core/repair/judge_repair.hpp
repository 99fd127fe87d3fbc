#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/repair/figures.hpp"
#include "core/repair/repair_windows.hpp"
#include "core/repair/standing_fault.hpp"

namespace loopscope::core::repair {

/// Whether the work helped; README.md has when each is said.
enum class Outcome { fixed, improved, unchanged, worse };

/// "fixed", ... as the results schema has it.
[[nodiscard]] std::string_view name(Outcome outcome);

/// What came of one piece of work.
struct RepairJudgement {
  std::optional<Outcome> outcome;  ///< nullopt = one side has no usable window
  std::string statement;           ///< a sentence or two with the figures; or why there is none yet
  std::size_t windows_before = 0, windows_after = 0;
  std::optional<StandingFault> fault_before, fault_after;
  std::vector<FigureChange> figures;  ///< by name

  /// Variance of the error after over before, with its 90 % interval; nullopt = one side has none.
  [[nodiscard]] std::optional<Interval> variance_ratio() const;
};

/// Compares up to six windows before a piece of work with up to six after it. Every figure's
/// change has an interval that holds the ordinary change of a loop that nobody touched; the
/// outcome weighs size and cost of the fault by it.
[[nodiscard]] RepairJudgement judge_repair(const RepairWindows& windows);

}  // namespace loopscope::core::repair
