#include "storage/historian/column_types.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "storage/historian/statements.hpp"
#include "storage/utf8.hpp"

namespace loopscope::storage {
namespace {

template <std::size_t count>
bool is_among(const std::array<std::string_view, count>& known, const std::string& word) {
  return std::find(known.begin(), known.end(), word) != known.end();
}

ColumnTypes read_columns(PqConnection& connection, std::uint32_t relation_oid) {
  ColumnTypes types;
  const PqRows rows =
      connection.run(historian_statements::kColumns, {std::to_string(relation_oid)});
  for (int row = 0; row < rows.size(); ++row) types[rows.text(row, 0)] = rows.text(row, 1);
  return types;
}

}  // namespace

RelationName split_relation(const std::string& relation) {
  const std::size_t dot = relation.find('.');
  if (dot == std::string::npos) return {"", relation};
  return {relation.substr(0, dot), relation.substr(dot + 1)};
}

std::optional<FoundRelation> find_relation(PqConnection& connection, const RelationName& name) {
  for (const std::string* part : {&name.schema, &name.table}) {
    if (!is_storable(*part) || part->size() > kLongestIdentifier) return std::nullopt;
  }
  const PqRows rows = connection.run(historian_statements::kFindRelation,
                                     {name.schema, name.table, connection.own_schemas()});
  if (rows.size() == 0) return std::nullopt;
  FoundRelation found;
  found.oid = static_cast<std::uint32_t>(std::stoul(rows.text(0, 0)));
  found.sql = connection.quote(rows.text(0, 1)) + "." + connection.quote(rows.text(0, 2));
  found.is_table = rows.text(0, 3) == "t";
  found.types = read_columns(connection, found.oid);
  return found;
}

std::string list_of(const ColumnTypes& types) {
  std::string list;
  for (const auto& [name, type] : types) list += (list.empty() ? "" : ", ") + name;
  return list;
}

bool is_number_type(const std::string& type) {
  constexpr std::array<std::string_view, 7> kNumbers{"float4", "float8",  "int2", "int4",
                                                     "int8",   "numeric", "bool"};
  return is_among(kNumbers, type);
}

bool is_text_type(const std::string& type) {
  constexpr std::array<std::string_view, 4> kTexts{"text", "varchar", "bpchar", "name"};
  return is_among(kTexts, type);
}

}  // namespace loopscope::storage
