#include "storage/historian/setup/check_foreign_table.hpp"

#include <charconv>
#include <string>

#include "storage/historian/find_partitions.hpp"
#include "storage/historian/scan.hpp"
#include "storage/historian/statements.hpp"
#include "storage/quoted_identifier.hpp"
#include "storage/timestamp.hpp"
#include "storage/utf8.hpp"

namespace loopscope::storage {
namespace {

// Rows of a window; mysql_fdw asks for 100 at a time unless it is told otherwise.
constexpr int kWholeWindow = 4096;
constexpr int kUsualPortion = 100;
constexpr std::size_t kMostNamed = 24;

struct ForeignTable {
  std::string server, wrapper, database;
  int portion = kUsualPortion;  ///< fetch_size
  bool server_has_portion = false;
};

ForeignTable read_options(const PqRows& rows) {
  ForeignTable table{rows.text(0, 0), rows.text(0, 1), rows.text(0, 2), kUsualPortion,
                     rows.text(0, 4) == "t"};
  const std::string portion = rows.text(0, 3);
  std::from_chars(portion.data(), portion.data() + portion.size(), table.portion);
  return table;
}

/// Every portion is a round trip to the other server.
Finding portions(const ForeignTable& table, const std::string& relation) {
  const std::string words = "the rows of a window come in portions of " +
                            std::to_string(table.portion) + " from server " +
                            make_storable(table.server) + ", " + relation;
  if (table.portion >= kWholeWindow) return {true, words, "", false};
  return {true, words,
          "ALTER SERVER " + quoted_identifier(table.server) + " OPTIONS (" +
              (table.server_has_portion ? "SET" : "ADD") + " fetch_size '5000')",
          true};
}

std::string import_statement(const ForeignTable& table, const std::string& names,
                             const ResolvedPartitions& list) {
  return "IMPORT FOREIGN SCHEMA " + quoted_identifier(table.database) + " LIMIT TO (" + names +
         ") FROM SERVER " + quoted_identifier(table.server) + " INTO " +
         quoted_identifier(list.schema.empty() ? "public" : list.schema);
}

/// Those that windows and the rows before them may need.
Finding imports(PqConnection& connection, const ResolvedLayout& layout, const ForeignTable& table,
                std::int64_t now_us) {
  const Partitions partitions(connection, layout);
  const auto missing = partitions.missing(now_us - kReachBefore_us, kLatestTimeUs);
  const std::string& list = layout.layout.partitions->relation;
  if (missing.empty())
    return {true, "the tables that " + list + " lists for the last year are there", "", false};
  std::string names, quoted;
  for (std::size_t k = 0; k < missing.size() && k < kMostNamed; ++k) {
    names += (k == 0 ? "" : ", ") + make_storable(missing[k].name);
    quoted += (k == 0 ? "" : ", ") + quoted_identifier(make_storable(missing[k].name));
  }
  if (missing.size() > kMostNamed) names += ", ...";
  return {
      true,
      std::to_string(missing.size()) + " of the tables that " + list +
          " lists for the last year were not imported, and windows that need them are refused: " +
          names,
      import_statement(table, quoted, *layout.partitions), true};
}

}  // namespace

std::vector<Finding> check_foreign_table(PqConnection& connection, const ResolvedLayout& layout,
                                         std::int64_t now_us) {
  const PqRows rows =
      connection.run(historian_statements::kForeignTable, {std::to_string(layout.data.oid)});
  if (rows.size() == 0) return {};
  const ForeignTable table = read_options(rows);
  std::vector<Finding> findings;
  if (table.wrapper == "mysql_fdw") findings.push_back(portions(table, layout.data.sql));
  if (layout.partitions) findings.push_back(imports(connection, layout, table, now_us));
  return findings;
}

}  // namespace loopscope::storage
