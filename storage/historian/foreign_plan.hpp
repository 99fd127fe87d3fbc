#pragma once

#include <string>
#include <vector>

#include "storage/historian/pq_rows.hpp"
#include "storage/historian/resolve_layout.hpp"

namespace loopscope::storage {

/// A node of a plan that reads a foreign table.
struct ForeignScan {
  std::string sent;    ///< what the other server is asked; empty = its wrapper does not tell
  std::string filter;  ///< conditions that are left to PostgreSQL; empty = none
};

/// Those of the lines of EXPLAIN (VERBOSE), in their order.
[[nodiscard]] std::vector<ForeignScan> foreign_scans(const PqRows& plan);

/// Whether the server that has the rows of a foreign table is itself asked for the largest time of
/// a key. Its index on (tag, time) then answers at once, however far back the newest row lies.
/// Where PostgreSQL would fetch the rows to find it, as with wrappers that send no aggregates and
/// below partitions or views that convert columns, false. Throws DatabaseError.
[[nodiscard]] bool asks_for_largest(PqConnection& connection, const ResolvedLayout& layout);

}  // namespace loopscope::storage
