#pragma once

#include <cstddef>
#include <string>

namespace loopscope::storage {

/// How many rows a statement returns when all is well.
enum class Rows { none, one, any };

/// One SQL statement of the program. Its name appears in messages, so that an operator and the
/// source speak of the same thing.
struct Statement {
  const char* name;  ///< of static storage
  std::string sql;
  Rows rows = Rows::any;
};

/// Throws DatabaseError (give_up) when `found` rows are not what the statement promises.
void check_rows(const Statement& statement, std::size_t found);

}  // namespace loopscope::storage
