#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "storage/connection_settings.hpp"
#include "storage/server_clock.hpp"

namespace loopscope::storage {

/// The schema version that this program reads and writes: the number of its newest migration.
[[nodiscard]] int required_schema_version();

/// Brings the schema `loopscope` up to date in one transaction, one program at a time, makes the
/// partitions of this month and the next three, and grants rights to those of the group roles that
/// exist. A member of loopscope_owner makes everything
/// as that role, so that every other member can change it. Returns the names of the migrations
/// applied (empty = nothing to do). A schema that all superseded migrations have made is taken over
/// (replace_superseded.hpp). Refuses (DatabaseError) a schema newer than the program, one of an
/// earlier version of that chain, and one whose recorded migrations differ from the compiled-in
/// ones. Blocks without a limit, whatever settings.statement_timeout_s says, as maintain() does.
std::vector<std::string> migrate(const ConnectionSettings& owner);

/// What maintain() did.
struct MaintenanceResult {
  std::vector<std::string> created;     ///< partitions made ahead
  std::vector<std::string> dropped;     ///< partitions older than the retention
  std::string first_month, last_month;  ///< that have partitions now: "2026-05"
};

/// What maintain() is to do.
struct MaintenanceOrders {
  int retention_months = 0;  ///< 0 = keep all
  ClockCheck check = {};     ///< asked before anything is made or dropped
  bool drop_many = false;    ///< a person says that more than kMostMonthsAtOnce may go
  /// Months from then on (microseconds UTC since 1970, not after now()) get partitions as well.
  std::optional<std::int64_t> since_us = std::nullopt;
};

/// Run once a day, `maintain` drops a month at a time, or two after a month in which it failed.
/// More at once looks like a clock that is ahead.
inline constexpr int kMostMonthsAtOnce = 2;

/// Makes partitions ahead, those of past months where they are wanted, and drops those that end
/// `retention_months` before the newest result that is not after now(): a clock that has run on
/// without results expires nothing. Where more than kMostMonthsAtOnce would go, nothing does and it
/// throws DatabaseError. Each is done in tries that keep no reader waiting
/// (transact_between_others). Workers that are gone and old figures of what stages cost go whatever
/// is kept. A newer schema that still serves this program is kept up by its own functions, so that
/// a program that was put back goes on; any other one is refused (DatabaseError).
MaintenanceResult maintain(const ConnectionSettings& owner, const MaintenanceOrders& orders);

}  // namespace loopscope::storage
