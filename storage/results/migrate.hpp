#pragma once

#include <string>
#include <vector>

#include "storage/connection_settings.hpp"

namespace loopscope::storage {

/// The schema version that this program reads and writes: the number of its newest migration.
[[nodiscard]] int required_schema_version();

/// Brings the schema `loopscope` up to date in one transaction under an advisory lock, makes the
/// partitions of this month and the next three, and grants rights to those of the roles
/// loopscope_worker and loopscope_reader that exist. A member of loopscope_owner makes everything
/// as that role, so that every other member can change it. Returns the names of the migrations
/// applied (empty = nothing to do). Refuses (DatabaseError) a schema newer than the program and one
/// whose recorded migrations differ from the compiled-in ones.
std::vector<std::string> migrate(const ConnectionSettings& owner);

/// What maintain() did.
struct MaintenanceResult {
  std::vector<std::string> created;  ///< partitions made ahead
  std::vector<std::string> dropped;  ///< partitions older than the retention
};

/// Makes partitions ahead and drops those that end before now minus `retention_months` (0 = keep
/// all). A newer schema that still serves this program is kept up by its own functions, so that a
/// program that was put back goes on; any other one is refused (DatabaseError).
MaintenanceResult maintain(const ConnectionSettings& owner, int retention_months);

}  // namespace loopscope::storage
