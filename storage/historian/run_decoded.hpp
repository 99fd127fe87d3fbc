#pragma once

#include <string>
#include <vector>

#include "storage/historian/binary_array.hpp"
#include "storage/historian/pq_connection.hpp"

namespace loopscope::storage {

/// Runs `read(rows)` on the answer and turns bytes that make no sense into a database error.
template <typename Read>
void run_decoded(PqConnection& connection, const Statement& statement,
                 const std::vector<std::string>& parameters, Read read) {
  const PqRows rows = connection.run(statement, parameters, ResultFormat::binary);
  try {
    read(rows);
  } catch (const MalformedArray& error) {
    throw DatabaseError(
        std::string(error.what()) + ", statement " + statement.name + ", " + connection.target(),
        "the server answered in a form that this program does not know: report "
        "this with the server's version",
        Remedy::give_up);
  }
}

}  // namespace loopscope::storage
