#pragma once

#include <cstddef>
#include <string>

namespace loopscope::storage {

/// How many rows a statement returns when all is well.
enum class Rows { none, one, any };

/// What a connection keeps of a statement for its next use: nothing; what the server has read in
/// its text, planned anew by the values each time; or the plan too, made without values: for rows
/// that are inserted out of arrays, or what can go no other way than by one index.
enum class Kept { nothing, text, plan };

/// One SQL statement of the program. Its name appears in messages, so that an operator and the
/// source speak of the same thing.
struct Statement {
  const char* name;  ///< of static storage
  std::string sql;
  Rows rows = Rows::any;
  Kept kept = Kept::nothing;
};

/// Throws DatabaseError (give_up) when `found` rows are not what the statement promises.
void check_rows(const Statement& statement, std::size_t found);

}  // namespace loopscope::storage
