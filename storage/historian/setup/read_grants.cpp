#include "storage/historian/setup/read_grants.hpp"

#include <algorithm>
#include <set>

#include "storage/array_literal.hpp"
#include "storage/historian/statements.hpp"
#include "storage/quoted_identifier.hpp"

namespace loopscope::storage {
namespace {

/// The tables of a layout but for the data's own.
std::vector<std::string> side_tables(const SourceLayout& layout) {
  std::vector<std::string> tables;
  if (layout.partitions) tables.push_back(layout.partitions->relation);
  for (const KeyPart& part : layout.key) {
    if (part.names) tables.push_back(part.names->relation);
  }
  if (layout.quality.names) tables.push_back(layout.quality.names->relation);
  return tables;
}

std::string oids_of(PqConnection& connection, const ResolvedLayout& layout) {
  ArrayLiteral oids;
  oids.add_text(std::to_string(layout.data.oid));
  for (const std::string& table : side_tables(layout.layout)) {
    if (const auto found = find_relation(connection, split_relation(table)))
      oids.add_text(std::to_string(found->oid));
  }
  return oids.text();
}

std::string joined(const std::vector<std::string>& parts, const std::string& comma) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : comma) + part;
  return text;
}

}  // namespace

std::vector<std::string> read_grants(const std::vector<TableName>& tables, const std::string& user,
                                     const std::string& maker) {
  const std::string to = " TO " + quoted_identifier(user);
  std::set<std::string> schemas;
  std::vector<std::string> names;
  for (const TableName& table : tables) {
    schemas.insert(quoted_identifier(table.schema));
    names.push_back(quoted_identifier(table.schema) + "." + quoted_identifier(table.table));
  }
  const std::string all = joined({schemas.begin(), schemas.end()}, ", ");
  std::vector<std::string> grants{"GRANT USAGE ON SCHEMA " + all + to};
  if (maker.empty()) {
    grants.push_back("GRANT SELECT ON " + joined(names, ", ") + to);
  } else {
    grants.push_back("GRANT SELECT ON ALL TABLES IN SCHEMA " + all + to);
    grants.push_back("ALTER DEFAULT PRIVILEGES FOR ROLE " + quoted_identifier(maker) +
                     " IN SCHEMA " + all + " GRANT SELECT ON TABLES" + to);
  }
  return grants;
}

std::optional<Finding> check_read_rights(PqConnection& connection, const ResolvedLayout& layout) {
  const PqRows rows =
      connection.run(historian_statements::kReadRights, {oids_of(connection, layout)});
  std::vector<TableName> lacking;
  std::string user, maker;
  for (int row = 0; row < rows.size(); ++row) {
    if (rows.text(row, 2) == "t") continue;
    lacking.push_back({rows.text(row, 0), rows.text(row, 1)});
    user = rows.text(row, 3);
    if (layout.partitions) maker = rows.text(row, 4);
  }
  if (lacking.empty()) return std::nullopt;
  return Finding{false,
                 user + " has no right to read " + lacking.front().schema + "." +
                     lacking.front().table + ", " + connection.target(),
                 "as the owner: " + joined(read_grants(lacking, user, maker), "; "), false};
}

}  // namespace loopscope::storage
