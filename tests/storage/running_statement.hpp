#pragma once

#include <string>

#include "tests/support/test_database.hpp"

namespace loopscope::storage {

/// Whether nobody runs this statement in the database any more, within two seconds.
[[nodiscard]] bool ends_soon(const tests::TestDatabase& database, const std::string& statement);

}  // namespace loopscope::storage
