#include "storage/historian/resolve_layout.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <map>
#include <string_view>
#include <vector>

#include "storage/historian/native_time.hpp"
#include "storage/historian/statements.hpp"
#include "storage/utf8.hpp"

namespace loopscope::storage {
namespace {

using Types = std::vector<std::string>;

[[noreturn]] void refuse(const std::string& what, const NarrowLayout& layout,
                         const std::string& hint) {
  throw DatabaseError(what + ", historian " + layout.source + " (" + layout.relation + ")", hint,
                      Remedy::give_up);
}

/// The types of the columns by name. A domain counts as the type below it.
using ColumnTypes = std::map<std::string, std::string>;

ColumnTypes read_columns(PqConnection& connection, std::uint32_t relation_oid) {
  ColumnTypes types;
  const PqRows rows =
      connection.run(historian_statements::kColumns, {std::to_string(relation_oid)});
  for (int row = 0; row < rows.size(); ++row) types[rows.text(row, 0)] = rows.text(row, 1);
  return types;
}

std::string known_columns(const ColumnTypes& types) {
  std::string list;
  for (const auto& [name, type] : types) list += (list.empty() ? "" : ", ") + name;
  return list;
}

/// The column's type, which must be one of `usable`.
std::string require_column(const ColumnTypes& types, const NarrowLayout& layout,
                           const std::string& setting, const std::string& column,
                           const Types& usable) {
  const auto found = types.find(column);
  if (found == types.end()) {
    refuse("no column \"" + column + "\"", layout,
           "set `" + setting + "` to one of: " + known_columns(types));
  }
  if (std::ranges::find(usable, found->second) == usable.end()) {
    std::string list;
    for (const std::string& type : usable) list += (list.empty() ? "" : ", ") + type;
    refuse("column \"" + column + "\" has the unusable type " + found->second, layout,
           "`" + setting + "` reads " + list + "; a view can convert the column");
  }
  return found->second;
}

/// Shorter whole numbers compare with int8 by the same index.
Types time_types(TimeKind kind) {
  const std::string type = native_type(kind);
  return type == "int8" ? Types{type, "int4"} : Types{type};
}

/// Tags are compared as this type, so that the column's index can be used.
std::string request_type(const std::string& column_type) {
  if (column_type.starts_with("int")) return "int8";
  if (column_type == "uuid" || column_type == "bpchar") return column_type;
  return "text";
}

bool is_uuid(const std::string& text) {
  constexpr std::string_view kForm = "hhhhhhhh-hhhh-hhhh-hhhh-hhhhhhhhhhhh";
  const auto fits = [](char character, char form) {
    return form == '-' ? character == '-'
                       : std::isxdigit(static_cast<unsigned char>(character)) != 0;
  };
  return std::equal(text.begin(), text.end(), kForm.begin(), kForm.end(), fits);
}

bool is_int8(const std::string& text) {
  std::int64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc{} && stop == end;
}

ResolvedLayout find_relation(PqConnection& connection, const NarrowLayout& layout) {
  const RelationName name = split_relation(layout.relation);
  if (!is_storable(layout.relation)) refuse("not a table's name", layout, "names are UTF-8 text");
  const PqRows rows =
      connection.run(historian_statements::kFindRelation, {name.schema, name.table});
  if (rows.size() == 0) {
    refuse(
        "no such table or view", layout,
        "set `table` to schema.table as it stands in the catalogue (upper and lower case count), "
        "in " +
            connection.target());
  }
  ResolvedLayout resolved;
  resolved.layout = layout;
  resolved.relation_oid = static_cast<std::uint32_t>(std::stoul(rows.text(0, 0)));
  resolved.relation = connection.quote(rows.text(0, 1)) + "." + connection.quote(rows.text(0, 2));
  resolved.is_table = rows.text(0, 3) == "t";
  return resolved;
}

}  // namespace

RelationName split_relation(const std::string& relation) {
  const std::size_t dot = relation.find('.');
  if (dot == std::string::npos) return {"", relation};
  return {relation.substr(0, dot), relation.substr(dot + 1)};
}

bool has_quality(const NarrowLayout& layout) {
  return !layout.quality_column.empty() && layout.quality_rule != QualityRule::none;
}

ResolvedLayout resolve_layout(PqConnection& connection, const NarrowLayout& layout) {
  ResolvedLayout resolved = find_relation(connection, layout);
  const ColumnTypes types = read_columns(connection, resolved.relation_oid);
  resolved.tag_type = request_type(
      require_column(types, layout, "tag_column", layout.tag_column,
                     {"text", "varchar", "bpchar", "name", "int2", "int4", "int8", "uuid"}));
  require_column(types, layout, "time_column", layout.time_column, time_types(layout.time_kind));
  require_column(types, layout, "value_column", layout.value_column,
                 {"float4", "float8", "int2", "int4", "int8", "numeric", "bool"});
  resolved.tag = connection.quote(layout.tag_column);
  resolved.time = connection.quote(layout.time_column);
  resolved.value = connection.quote(layout.value_column);
  // There is no direct way from boolean to double.
  resolved.value_cast = types.at(layout.value_column) == "bool" ? "::int4::float8" : "::float8";
  if (has_quality(layout)) {
    require_column(types, layout, "quality_column", layout.quality_column,
                   {"int2", "int4", "int8"});
    resolved.quality = connection.quote(layout.quality_column);
  }
  return resolved;
}

std::optional<std::string> native_tag(const std::string& tag, const std::string& tag_type) {
  const bool possible = tag_type == "int8"   ? is_int8(tag)
                        : tag_type == "uuid" ? is_uuid(tag)
                                             : is_storable(tag);
  if (!possible) return std::nullopt;
  return tag;
}

}  // namespace loopscope::storage
