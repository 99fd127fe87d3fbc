#pragma once

#include "storage/error.hpp"

namespace loopscope::daemon {

/// Whether a database error comes from the rows of some loop (a value that cannot be read or
/// stored) and not from the database: then the others of the batch can do without it.
[[nodiscard]] inline bool speaks_of_rows(const storage::DatabaseError& error) {
  // SQLSTATE classes: data exception, integrity constraint, program limit (a text too long).
  for (const char* row_class : {"22", "23", "54"}) {
    if (error.sqlstate().starts_with(row_class)) return true;
  }
  return false;
}

}  // namespace loopscope::daemon
