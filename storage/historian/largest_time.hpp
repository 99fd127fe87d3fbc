#pragma once

#include <string>
#include <vector>

#include "storage/historian/resolve_layout.hpp"

namespace loopscope::storage {

namespace historian_statements {
/// A query with one row, o0: the largest time among the rows of `relations` of which `within`
/// holds, as the column has it; NULL = there is none.
[[nodiscard]] std::string largest_time(const ResolvedLayout& layout,
                                       const std::vector<std::string>& relations,
                                       const std::string& within);
}  // namespace historian_statements

/// Whether the server that has the rows of a foreign table is itself asked for the largest time of
/// a key. Its index on (tag, time) then answers at once, however far back the newest row lies.
/// Where PostgreSQL would fetch the rows to find it, as with wrappers that send no aggregates and
/// below partitions or views that convert columns, false. Throws DatabaseError.
[[nodiscard]] bool asks_for_largest(PqConnection& connection, const ResolvedLayout& layout);

}  // namespace loopscope::storage
