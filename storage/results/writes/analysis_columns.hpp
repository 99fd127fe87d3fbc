#pragma once

#include <span>
#include <string_view>

#include "storage/array_literal.hpp"
#include "storage/loop_work.hpp"

namespace loopscope::storage {

/// One column of loopscope.analysis: its name, the type of the array that carries it, the cast
/// that it needs besides (text[] and jsonb travel as text), and what it holds of a loop, which has
/// a record.
struct AnalysisColumn {
  std::string_view name;
  std::string_view type;
  void (*add)(ArrayLiteral&, const CompletedLoop&);
  std::string_view cast{};
};

/// All that a record says, in the order of the statements (analysis_statements.hpp).
[[nodiscard]] std::span<const AnalysisColumn> analysis_columns();

}  // namespace loopscope::storage
