#pragma once

#include <string>

#include "storage/historian/pq_connection.hpp"
#include "storage/historian/source_layout.hpp"

namespace loopscope::storage {

/// What a quality column says about a row, as SQL conditions.
struct QualitySql {
  std::string good;   ///< NULL counts as false; empty = every row is good
  std::string known;  ///< NULL counts as false: a code that is not known is bad, and counted
};

/// `column` is quoted SQL, `type` its name in pg_type. Throws DatabaseError (give_up) when the rule
/// does not fit the type, or when codes are named in a side table that does not know them.
[[nodiscard]] QualitySql quality_sql(PqConnection& connection, const SourceLayout& layout,
                                     const std::string& column, const std::string& type);

}  // namespace loopscope::storage
