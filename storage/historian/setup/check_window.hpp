#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "storage/check_connection.hpp"
#include "storage/historian/pq_connection.hpp"
#include "storage/historian/resolve_layout.hpp"

namespace loopscope::storage {

/// SQL of some value of a row, for what does not depend on which tag it is. Throws DatabaseError
/// when no column holds numbers.
[[nodiscard]] std::string any_value(const PqConnection& connection, const ResolvedLayout& layout);

/// What the planner makes of the statement that reads windows, and what comes of running that very
/// statement, the look for the row before included, for a tag that has rows: a foreign table may
/// plan what it cannot carry out. Throws DatabaseError and MalformedArray for what is no finding:
/// a lost connection, say.
[[nodiscard]] std::vector<Finding> check_window(PqConnection& connection,
                                                const ResolvedLayout& layout, std::int64_t now_us);

}  // namespace loopscope::storage
