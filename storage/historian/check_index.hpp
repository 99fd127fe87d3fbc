#pragma once

#include "storage/check_connection.hpp"
#include "storage/historian/pq_connection.hpp"
#include "storage/historian/resolve_layout.hpp"

namespace loopscope::storage {

/// Whether the table of the data has an index that starts with key and time and, in narrow tables,
/// holds value and quality too; a warning with the statement that
/// makes it where there is none. Throws DatabaseError.
[[nodiscard]] Finding check_index(PqConnection& connection, const ResolvedLayout& layout);

/// Whether an index starts with key and time. Throws DatabaseError.
[[nodiscard]] bool has_key_index(PqConnection& connection, const ResolvedLayout& layout);

}  // namespace loopscope::storage
