#pragma once

#include <vector>

#include "storage/check_connection.hpp"
#include "storage/historian/pq_rows.hpp"

namespace loopscope::storage {

/// What the server that has the rows of a foreign table is asked for, one finding each: the
/// conditions of a window, its order and limit. `plan` are the lines of EXPLAIN (VERBOSE) of a
/// window; `relation` is its table.
[[nodiscard]] std::vector<Finding> check_foreign(const PqRows& plan, const std::string& relation);

}  // namespace loopscope::storage
