#pragma once

#include <string>
#include <vector>

#include "storage/historian/pq_rows.hpp"

namespace loopscope::storage {

/// A node of a plan that reads a foreign table.
struct ForeignScan {
  std::string sent;    ///< what the other server is asked; empty = its wrapper does not tell
  std::string filter;  ///< conditions that are left to PostgreSQL; empty = none
};

/// Those of the lines of EXPLAIN (VERBOSE), in their order.
[[nodiscard]] std::vector<ForeignScan> foreign_scans(const PqRows& plan);

}  // namespace loopscope::storage
