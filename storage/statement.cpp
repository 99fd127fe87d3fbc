#include "storage/statement.hpp"

#include "storage/error.hpp"

namespace loopscope::storage {

void check_rows(const Statement& statement, std::size_t found) {
  const bool wrong =
      (statement.rows == Rows::none && found != 0) || (statement.rows == Rows::one && found != 1);
  if (wrong) {
    throw DatabaseError(
        "unexpected number of rows, " + std::to_string(found) + ", statement " + statement.name,
        "the database is not the one that this program was built for", Remedy::give_up);
  }
}

}  // namespace loopscope::storage
