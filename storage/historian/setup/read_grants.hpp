#pragma once

#include <optional>
#include <string>
#include <vector>

#include "storage/check_connection.hpp"
#include "storage/historian/pq_connection.hpp"
#include "storage/historian/resolve_layout.hpp"

namespace loopscope::storage {

/// A table that a reader needs, by the names of its catalogue.
struct TableName {
  std::string schema, table;

  [[nodiscard]] bool operator==(const TableName&) const = default;
};

/// The statements that let `user` read `tables` (not empty): USAGE on their schemas, SELECT on
/// them, a statement each. With `new_tables_too` SELECT goes to every table of the schemas, also to
/// those that `maker` makes later: historians that begin a new table every month.
[[nodiscard]] std::vector<std::string> read_grants(const std::vector<TableName>& tables,
                                                   const std::string& user,
                                                   const std::string& maker = "");

/// Whether the connected login may read the tables of a layout, side tables included; the hint is
/// every grant that is missing at once. nullopt = it may. Throws DatabaseError.
[[nodiscard]] std::optional<Finding> check_read_rights(PqConnection& connection,
                                                       const ResolvedLayout& layout);

}  // namespace loopscope::storage
