#pragma once

#include <string>

#include "core/repair/judge_repair.hpp"

namespace loopscope::core::repair {

/// What a judgement's sentences speak of besides it.
struct StatementFigures {
  std::string suspected;                 ///< code suspected before; empty = none, or one stood
  const FigureChange* size = nullptr;    ///< of the fault that stands on both sides; null = none
  const FigureChange* spread = nullptr;  ///< error_std; null = no window has it
};

/// The outcome in a sentence or two for people; without an outcome, why there is none.
[[nodiscard]] std::string repair_statement(const RepairWindows& windows,
                                           const RepairJudgement& judgement,
                                           const StatementFigures& figures);

}  // namespace loopscope::core::repair
