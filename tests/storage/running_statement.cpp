#include "tests/storage/running_statement.hpp"

#include <unistd.h>

namespace loopscope::storage {

bool ends_soon(const tests::TestDatabase& database, const std::string& statement) {
  for (int tries = 0; tries < 40; ++tries) {
    const std::string running = database.value(
        "SELECT count(*) FROM pg_stat_activity WHERE datname = current_database()"
        " AND state = 'active' AND query = '" +
        statement + "'");
    if (running == "0") return true;
    usleep(50'000);
  }
  return false;
}

}  // namespace loopscope::storage
