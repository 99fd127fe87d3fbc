#pragma once

#include <cstdint>
#include <string>

#include "storage/results/leases/claim_watermark.hpp"

namespace loopscope::storage {

class Session;

/// How far the work as a whole is behind, over all workers and hosts, by the database's clock.
struct ScheduleHealth {
  std::int64_t enabled_loops = 0;
  /// Enabled loops that are due and that no living lease holds.
  std::int64_t overdue_loops = 0;
  /// Seconds since the one of them that waits longest was due; 0 = none waits.
  double lag_s = 0.0;
  std::int64_t failing_loops = 0;  ///< enabled loops whose last visit failed
  /// Months after the running one (UTC) for which every partitioned table has its partition,
  /// counted up to the first gap, 24 at most; -1 = the running month itself lacks one.
  int partition_months_ahead = 0;
  /// Rows whose month has no partition, counted up to kMostDefaultRows only.
  std::int64_t default_partition_rows = 0;
  /// Months from the oldest partition to the running one (UTC); 0 = there is none before it.
  int oldest_partition_months = 0;
  /// Transaction before which nothing dead can be removed: the oldest that a session, a prepared
  /// transaction or a replication slot keeps back, as PostgreSQL writes it; empty = none does.
  std::string oldest_snapshot = {};
};

inline constexpr std::int64_t kMostDefaultRows = 10'001;

/// Asks in one statement and a transaction of its own (storage/MEASURED.md). Loops that are due are
/// looked for behind the watermark of the claims, and suspects everywhere. Needs no right beyond
/// the worker's. Throws DatabaseError.
[[nodiscard]] ScheduleHealth schedule_health(Session& session, DuePlace watermark = kBeforeAll);

}  // namespace loopscope::storage
