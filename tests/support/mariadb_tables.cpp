#include "tests/support/mariadb_tables.hpp"

namespace loopscope::tests {
namespace {

/// Name and type of each column.
TextRows columns_of(const TestDatabase& database, const std::string& table) {
  return database.rows(
      "SELECT quote_ident(attname), format_type(atttypid, NULL), attname FROM pg_attribute"
      " WHERE attnum > 0 AND attrelid = '" +
      table + "'::regclass ORDER BY attnum");
}

/// As MariaDB takes its text.
std::string literal_of(const std::string& column, const std::string& type) {
  if (type == "timestamp with time zone")
    return "quote_nullable((" + column + " AT TIME ZONE 'UTC')::text)";
  if (type == "boolean") return "quote_nullable(" + column + "::int::text)";
  return "quote_nullable(" + column + "::text)";
}

/// The type that the vendor's tables have in MariaDB.
std::string type_there(const std::string& type) {
  if (type.starts_with("timestamp")) return "datetime(6)";
  if (type == "double precision") return "double";
  if (type == "real") return "float";
  if (type == "boolean") return "tinyint(1)";
  if (type == "numeric") return "decimal(30, 10)";
  if (type == "bytea") return "longblob";
  const bool whole = type == "bigint" || type == "integer" || type == "smallint";
  return whole ? type : "varchar(255) CHARACTER SET utf8mb4 COLLATE utf8mb4_bin";
}

}  // namespace

std::string as_insert(const TestDatabase& database, const std::string& table) {
  std::string columns;
  for (const auto& row : columns_of(database, table))
    columns += (columns.empty() ? "" : " || ',' || ") + literal_of(row[0], row[1]);
  const std::string values =
      database.value("SELECT string_agg('(' || " + columns + " || ')', ',') FROM " + table);
  return "INSERT INTO " + table + " VALUES " + values + ";";
}

std::string as_create(const TestDatabase& database, const std::string& table) {
  std::string columns;
  for (const auto& row : columns_of(database, table))
    columns += (columns.empty() ? "`" : ", `") + row[2] + "` " + type_there(row[1]);
  return "CREATE TABLE " + table + " (" + columns + ");";
}

}  // namespace loopscope::tests
