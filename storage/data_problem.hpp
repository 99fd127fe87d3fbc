#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace loopscope::storage {

/// Something about a loop's data that somebody should mend, as it stands at the newest slot.
struct DataProblem {
  std::string code;  ///< a flag of the analysis, or a code of loopscope.data_problem_kind
  std::string role;  ///< sp, pv, op, mv, mode; empty = as data_problem_kind says
  std::optional<std::int64_t> last_row_us;  ///< the tag's newest row, where that is what is wrong
  std::optional<double> figure;             ///< how much of it
};

}  // namespace loopscope::storage
