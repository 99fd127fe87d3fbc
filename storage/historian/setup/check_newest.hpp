#pragma once

#include <cstdint>

#include "storage/check_connection.hpp"
#include "storage/historian/pq_connection.hpp"
#include "storage/historian/resolve_layout.hpp"

namespace loopscope::storage {

/// How old the newest row of the table (of a foreign one: of some tag) is by its server's clock
/// (`now_us`, microseconds UTC), with a warning where it lies in the future, where none is younger
/// than a week, and where the rows of its tag came so much closer before that the recording stands
/// still or its times are of another zone. A server that gives up a statement is no problem. Throws
/// DatabaseError.
[[nodiscard]] Finding check_newest(PqConnection& connection, const ResolvedLayout& layout,
                                   std::int64_t now_us);

}  // namespace loopscope::storage
