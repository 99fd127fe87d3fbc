#pragma once

#include <string>
#include <vector>

#include "storage/historian/column_types.hpp"
#include "storage/historian/pq_connection.hpp"

namespace loopscope::storage {

/// The columns that an index should start with and those that it should hold besides.
struct WantedIndex {
  std::vector<std::string> key, include;
};

struct IndexAdvice {
  std::string sql;    ///< statements, each with its semicolon
  std::string owner;  ///< of the table: who may run it
};

/// The SQL that makes it, as PostgreSQL takes it for this table and, where it can be done, without
/// keeping the historian from writing: CONCURRENTLY on a plain table; on one that is partitioned,
/// which refuses that, first on the parent ONLY, then on each partition, which is attached; on a
/// hypertable of TimescaleDB chunk by chunk. Throws DatabaseError.
[[nodiscard]] IndexAdvice index_advice(PqConnection& connection, const FoundRelation& table,
                                       const WantedIndex& wanted);

}  // namespace loopscope::storage
