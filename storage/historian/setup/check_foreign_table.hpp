#pragma once

#include <cstdint>
#include <vector>

#include "storage/check_connection.hpp"
#include "storage/historian/pq_connection.hpp"
#include "storage/historian/resolve_layout.hpp"

namespace loopscope::storage {

/// What a site has to know of its foreign tables: in what portions rows come, and which tables of a
/// list were never imported. Nothing of a layout whose table is native. Throws DatabaseError.
[[nodiscard]] std::vector<Finding> check_foreign_table(PqConnection& connection,
                                                       const ResolvedLayout& layout,
                                                       std::int64_t now_us);

}  // namespace loopscope::storage
