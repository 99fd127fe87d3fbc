#pragma once

#include <string>
#include <vector>

#include "storage/historian/resolve_layout.hpp"
#include "storage/historian/scan.hpp"

namespace loopscope::storage::historian_statements {

/// The newest row of each column that wants it before each request's span.
struct RowsBefore {
  std::string columns;  ///< ", b0.time, b0.value, ..."
  std::string joins;
};

/// Looks from `request.before_time` on or, where the rows are on another server, from each of
/// `request.before_0`, `request.before_1`, ... (spans_before) on.
[[nodiscard]] RowsBefore rows_before(const ResolvedLayout& layout,
                                     const std::vector<std::string>& relations,
                                     const std::vector<ScanColumn>& columns);

}  // namespace loopscope::storage::historian_statements
