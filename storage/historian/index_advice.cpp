#include "storage/historian/index_advice.hpp"

#include "storage/historian/statements.hpp"

namespace loopscope::storage {
namespace {

/// Of more partitions the sequence is told in words: nobody would read it.
constexpr int kMostPartitionsShown = 6;

std::string quoted_list(const PqConnection& connection, const std::vector<std::string>& columns) {
  std::string list;
  for (const std::string& column : columns) {
    list += (list.empty() ? "" : ", ") + connection.quote(column);
  }
  return list;
}

/// " (tag, time) INCLUDE (value)"
std::string columns_sql(const PqConnection& connection, const WantedIndex& wanted) {
  std::string sql = " (" + quoted_list(connection, wanted.key) + ")";
  if (!wanted.include.empty()) sql += " INCLUDE (" + quoted_list(connection, wanted.include) + ")";
  return sql;
}

/// Whether an index can be made on each partition CONCURRENTLY: none has partitions of its own.
bool are_plain(const PqRows& partitions) {
  for (int row = 0; row < partitions.size(); ++row) {
    if (partitions.text(row, 3) != "r") return false;
  }
  return partitions.size() > 0;
}

/// A name that no other index has: that of the table may be too long to be added to.
std::string index_name(const PqConnection& connection, const std::string& oid) {
  return connection.quote("loopscope_" + oid);
}

std::string each_partition(const PqConnection& connection, const FoundRelation& table,
                           const std::string& home, const PqRows& partitions,
                           const std::string& columns) {
  const std::string whole = index_name(connection, std::to_string(table.oid));
  std::string sql = "CREATE INDEX " + whole + " ON ONLY " + table.sql + columns;
  for (int row = 0; row < partitions.size(); ++row) {
    const std::string part = index_name(connection, partitions.text(row, 0));
    const std::string schema = connection.quote(partitions.text(row, 1));
    sql += "; CREATE INDEX CONCURRENTLY " + part + " ON " + schema + "." +
           connection.quote(partitions.text(row, 2)) + columns + "; ALTER INDEX " +
           connection.quote(home) + "." + whole + " ATTACH PARTITION " + schema + "." + part;
  }
  return sql + ";";
}

std::string of_partitioned(PqConnection& connection, const FoundRelation& table,
                           const std::string& home, const std::string& columns) {
  const PqRows partitions =
      connection.run(historian_statements::kPartitions, {std::to_string(table.oid)});
  if (are_plain(partitions) && partitions.size() <= kMostPartitionsShown)
    return each_partition(connection, table, home, partitions, columns);
  return "CREATE INDEX ON " + table.sql + columns +
         " /* keeps writers waiting meanwhile. Without that: CREATE INDEX ... ON ONLY the table, "
         "then for each partition CREATE INDEX CONCURRENTLY and ALTER INDEX ... ATTACH PARTITION "
         "*/;";
}

std::string sql_of(PqConnection& connection, const FoundRelation& table, const PqRows& kind,
                   const std::string& columns) {
  if (kind.text(0, 1) == "t")
    return "CREATE INDEX ON " + table.sql + columns + " WITH (timescaledb.transaction_per_chunk);";
  if (kind.text(0, 0) == "p") return of_partitioned(connection, table, kind.text(0, 2), columns);
  return "CREATE INDEX CONCURRENTLY ON " + table.sql + columns + ";";
}

}  // namespace

IndexAdvice index_advice(PqConnection& connection, const FoundRelation& table,
                         const WantedIndex& wanted) {
  const PqRows kind = connection.run(historian_statements::kTableKind, {std::to_string(table.oid)});
  return {sql_of(connection, table, kind, columns_sql(connection, wanted)), kind.text(0, 3)};
}

}  // namespace loopscope::storage
