#include "storage/historian/resolve_layout.hpp"

#include <algorithm>

#include "storage/historian/find_partitions.hpp"
#include "storage/historian/native_key.hpp"
#include "storage/historian/native_time.hpp"
#include "storage/historian/refuse.hpp"
#include "storage/historian/statements.hpp"
#include "storage/timestamp.hpp"
#include "storage/utf8.hpp"

namespace loopscope::storage {
namespace {

using Types = std::vector<std::string>;

/// The column's type, which must be one of `usable`.
std::string require_type(const SourceLayout& layout, const ColumnTypes& types,
                         const std::string& relation, const NamedColumn& column,
                         const Types& usable) {
  require_columns(layout, relation, types, {column});
  const std::string& found = types.at(column.second);
  if (std::ranges::find(usable, found) != usable.end()) return found;
  std::string list;
  for (const std::string& type : usable) list += (list.empty() ? "" : ", ") + type;
  refuse(layout, "column \"" + column.second + "\" has the unusable type " + found,
         "`" + column.first + "` reads " + list + "; a view can convert the column");
}

class Resolver {
 public:
  Resolver(PqConnection& connection, const SourceLayout& layout)
      : connection_(connection), layout_(layout) {}

  ResolvedLayout resolve() {
    ResolvedLayout resolved;
    resolved.layout = layout_;
    if (layout_.partitions) resolved.partitions = partition_list(*layout_.partitions);
    resolved.data = data_of(resolved);
    look_elsewhere(resolved);
    for (std::size_t part = 0; part < layout_.key.size(); ++part) {
      resolved.key.push_back(key_part(resolved.data.types, layout_.key[part], part));
    }
    times(resolved);
    if (has_quality(layout_)) {
      const std::string type =
          require_type(layout_, resolved.data.types, layout_.relation,
                       {"quality_column", layout_.quality_column},
                       {"int2", "int4", "int8", "bool", "text", "varchar", "bpchar", "name"});
      resolved.quality = quality_sql(connection_, layout_, column(layout_.quality_column), type);
    }
    if (layout_.shape == Shape::narrow) require_values(resolved.data.types);
    return resolved;
  }

 private:
  std::string column(const std::string& name) { return "h." + connection_.quote(name); }

  std::string quoted_or_empty(const std::string& name) {
    return name.empty() ? "" : connection_.quote(name);
  }

  FoundRelation table(const std::string& relation, const std::string& setting) {
    auto found = find_relation(connection_, split_relation(relation));
    if (!found) {
      refuse(layout_, "no such table or view: " + make_storable(relation),
             "set `" + setting +
                 "` to schema.table as it stands in the catalogue (upper and lower case count), "
                 "in " +
                 connection_.target());
    }
    return *std::move(found);
  }

  ResolvedPartitions partition_list(const PartitionList& list) {
    const FoundRelation found = table(list.relation, "partition_table");
    require_columns(layout_, list.relation, found.types,
                    {{"partition_name_column", list.name_column},
                     {"partition_start_column", list.start_column},
                     {"partition_end_column", list.end_column}});
    return {found.sql, connection_.quote(list.name_column), connection_.quote(list.start_column),
            connection_.quote(list.end_column), split_relation(list.relation).schema};
  }

  /// All listed tables have the same columns: any of them serves.
  FoundRelation data_of(const ResolvedLayout& resolved) {
    if (resolved.partitions) {
      Partitions partitions(connection_, resolved);
      if (auto any = partitions.any()) return *std::move(any);
      const auto missing = partitions.missing(kEarliestTimeUs, kLatestTimeUs);
      if (!missing.empty() && !find_relation(connection_, split_relation(layout_.relation)))
        refuse_missing(missing.back().name);
    }
    return table(layout_.relation, "table");
  }

  [[noreturn]] void refuse_missing(const std::string& name) {
    refuse(layout_,
           "none of the tables that " + layout_.partitions->relation + " lists is there, e.g. " +
               make_storable(name),
           "foreign tables have to be imported: IMPORT FOREIGN SCHEMA (config/FOREIGN_TABLES.md); "
           "others stand in the schema of `partition_table`");
  }

  /// For a value that is found at run time tds_fdw 2.0 sends "CAST(NULL AS text)".
  /// Of a timestamptz mysql_fdw sends bounds with their offset, which MySQL and MariaDB leave out:
  /// windows would be hours too early or too late.
  void look_elsewhere(ResolvedLayout& resolved) {
    const PqRows rows =
        connection_.run(historian_statements::kElsewhere, {std::to_string(resolved.data.oid)});
    resolved.foreign = rows.text(0, 0) == "t";
    resolved.parameters_elsewhere = rows.text(0, 2) != "t";
    const auto time = resolved.data.types.find(layout_.time_column);
    if (rows.text(0, 1) != "mysql_fdw" || time == resolved.data.types.end() ||
        time->second != "timestamptz")
      return;
    refuse(layout_,
           "column \"" + layout_.time_column +
               "\" of the foreign table is timestamptz, which MySQL and MariaDB do not have",
           "declare it as timestamp, and set `time_kind` to timestamp_utc or timestamp_local");
  }

  ResolvedKey key_part(const ColumnTypes& types, const KeyPart& part, std::size_t index) {
    const std::string setting = index == 0 ? "tag_column" : "subtag_column";
    const std::string type =
        require_type(layout_, types, layout_.relation, {setting, part.column},
                     {"text", "varchar", "bpchar", "name", "int2", "int4", "int8", "uuid"});
    ResolvedKey key{column(part.column), key_type(type), {}};
    if (part.names) key.names = names(part, index == 0 ? "tag" : "subtag");
    return key;
  }

  ResolvedNames names(const KeyPart& part, const std::string& prefix) {
    const SideTable& side = *part.names;
    const FoundRelation found = table(side.relation, prefix + "_table");
    require_type(layout_, found.types, side.relation, {prefix + "_name_column", side.name_column},
                 {"text", "varchar", "bpchar", "name"});
    require_columns(layout_, side.relation, found.types, {{prefix + "_id_column", side.id_column}});
    for (const NamedColumn& optional : {NamedColumn{prefix + "_order_column", part.order_column},
                                        NamedColumn{"interpolation_column", part.hold_column}}) {
      if (!optional.second.empty())
        require_columns(layout_, side.relation, found.types, {optional});
    }
    return {found.sql, connection_.quote(side.name_column), connection_.quote(side.id_column),
            quoted_or_empty(part.order_column), quoted_or_empty(part.hold_column)};
  }

  void times(ResolvedLayout& resolved) {
    const ColumnTypes& types = resolved.data.types;
    require_type(layout_, types, layout_.relation, {"time_column", layout_.time_column},
                 time_column_types(layout_.time_kind));
    resolved.time = column(layout_.time_column);
    if (!layout_.nanos_column.empty()) {
      require_type(layout_, types, layout_.relation, {"nanos_column", layout_.nanos_column},
                   {"int4", "int8"});
      resolved.nanos = "COALESCE(" + column(layout_.nanos_column) + ", 0)";
    }
    if (!layout_.tiebreak_column.empty()) {
      require_columns(layout_, layout_.relation, types,
                      {{"tiebreak_column", layout_.tiebreak_column}});
      resolved.tiebreak = column(layout_.tiebreak_column);
    }
    if (layout_.time_kind == TimeKind::timestamp_local) resolved.zone = zone();
  }

  std::string zone() {
    if (!is_storable(layout_.time_zone) ||
        connection_.run(historian_statements::kFindZone, {layout_.time_zone}).size() == 0) {
      refuse(layout_, "no such time zone: \"" + make_storable(layout_.time_zone) + "\"",
             "set `time_zone` to a name of pg_timezone_names, e.g. Europe/Berlin");
    }
    return connection_.quote_literal(layout_.time_zone);
  }

  void require_values(const ColumnTypes& types) {
    for (const std::string& value : layout_.value_columns) {
      require_columns(layout_, layout_.relation, types, {{"value_column", value}});
      const std::string& type = types.at(value);
      if (is_number_type(type) || is_text_type(type)) continue;
      refuse(layout_, "column \"" + value + "\" has the unusable type " + type,
             "`value_column` reads numbers, truths and texts; a view can convert the column");
    }
  }

  PqConnection& connection_;
  const SourceLayout& layout_;
};

}  // namespace

ResolvedLayout resolve_layout(PqConnection& connection, const SourceLayout& layout) {
  return Resolver(connection, layout).resolve();
}

}  // namespace loopscope::storage
