#include "storage/historian/statements.hpp"

#include "storage/historian/native_time.hpp"

namespace loopscope::storage::historian_statements {
namespace {

std::string native(const ResolvedLayout& layout) {
  return native_type(layout.layout.time_kind);
}

/// The time as the eight-byte type that native_time reads.
std::string time_sql(const ResolvedLayout& layout) {
  if (!layout.zone.empty()) return "(" + layout.time + " AT TIME ZONE " + layout.zone + ")";
  if (layout.nanos.empty()) return layout.time + "::" + native(layout);
  return "(date_trunc('second', " + layout.time + ") + (" + layout.nanos +
         " / 1000) * interval '1 microsecond')";
}

/// A bound in the column's own type: a conversion of the column would keep its index from use.
std::string bound_sql(const ResolvedLayout& layout, const std::string& bound) {
  return layout.zone.empty() ? bound : "(" + bound + " AT TIME ZONE " + layout.zone + ")";
}

/// "h"."key" = request.k0 AND ...
std::string key_is_requested(const ResolvedLayout& layout) {
  std::string sql;
  for (std::size_t part = 0; part < layout.key.size(); ++part) {
    sql += layout.key[part].column + " = request.k" + std::to_string(part) + " AND ";
  }
  return sql;
}

std::string parameter(std::size_t number, const std::string& type) {
  return "$" + std::to_string(number) + "::" + type;
}

/// Arrays of the key's parts as parameters from $1 on, and the names of their elements.
struct KeyArrays {
  std::string parameters, names;
};

KeyArrays key_arrays(const ResolvedLayout& layout) {
  KeyArrays arrays;
  for (std::size_t part = 0; part < layout.key.size(); ++part) {
    arrays.parameters += parameter(part + 1, layout.key[part].type) + "[], ";
    arrays.names += "k" + std::to_string(part) + ", ";
  }
  return arrays;
}

/// SELECT `what` of every relation, put together; " AS u" still has to follow.
std::string all_of(const std::vector<std::string>& relations, const std::string& what,
                   const std::string& condition) {
  std::string sql;
  for (const std::string& relation : relations) {
    sql += (sql.empty() ? "(" : " UNION ALL ");
    sql += "SELECT " + what + " FROM " + relation + " AS h WHERE " + condition;
  }
  return sql + ")";
}

/// The columns that rows are ordered by, as they are: o0, o1, ...
struct Order {
  std::string columns;       ///< "h.time AS o0, h.id AS o1"
  std::string newest_first;  ///< "u.o0 DESC, u.o1 DESC"
};

Order order_of(const ResolvedLayout& layout) {
  Order order;
  int number = 0;
  for (const std::string* column : {&layout.time, &layout.nanos, &layout.tiebreak}) {
    if (column->empty()) continue;
    const std::string name = "o" + std::to_string(number++);
    order.columns += *column + " AS " + name + ", ";
    order.newest_first += (order.newest_first.empty() ? "u." : ", u.") + name + " DESC";
  }
  return order;
}

/// One table of arrays per request: its span.
std::string span_sql(const ResolvedLayout& layout, const std::vector<std::string>& relations,
                     const std::vector<ScanColumn>& columns) {
  const Order order = order_of(layout);
  std::string row = order.columns + time_sql(layout) + " AS time";
  std::string arrays = "array_agg(x.time) AS times, ";
  if (layout.quality.known.empty()) {
    arrays += "0::int8 AS unknown";
  } else {
    row += ", " + layout.quality.known + " AS known";
    arrays += "count(*) FILTER (WHERE x.known IS NOT TRUE) AS unknown";
  }
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const std::string name = "v" + std::to_string(k);
    row += ", " + columns[k].value + " AS " + name;
    arrays += ", array_agg(x." + name + ") AS " + name;
  }
  const std::string within = key_is_requested(layout) + layout.time +
                             " >= " + bound_sql(layout, "request.from_time") + " AND " +
                             layout.time + " <= " + bound_sql(layout, "request.to_time");
  return "SELECT " + arrays + " FROM (SELECT u.* FROM " + all_of(relations, row, within) +
         " AS u ORDER BY " + order.newest_first + " LIMIT request.max_rows) AS x";
}

/// The newest row of one column before each request's span.
std::string before_sql(const ResolvedLayout& layout, const std::vector<std::string>& relations,
                       const std::string& value) {
  const Order order = order_of(layout);
  std::string within = key_is_requested(layout) + layout.time +
                       " >= " + bound_sql(layout, "request.before_time") + " AND " + layout.time +
                       " < " + bound_sql(layout, "request.from_time");
  if (layout.layout.null_is_absent) within += " AND " + value + " IS NOT NULL";
  const std::string row = order.columns + time_sql(layout) + " AS time, " + value + " AS value";
  return "SELECT u.time, u.value FROM " + all_of(relations, row, within) + " AS u ORDER BY " +
         order.newest_first + " LIMIT 1";
}

/// Names to ids; several of a name in the order in which they were made.
std::string ids_sql(const ResolvedNames& names, const std::string& condition) {
  const std::string hold = names.hold.empty() ? "NULL" : "n." + names.hold + "::text";
  const std::string order = names.order.empty() ? "" : ", n." + names.order;
  return "SELECT request.name, n." + names.id + "::text, " + hold +
         " FROM unnest($1::text[]) AS request (name) JOIN " + names.relation + " AS n ON " +
         condition + " ORDER BY request.name" + order + ", n." + names.id;
}

/// WHERE for one tag in a span given by parameters $1 (tag), $2 and $3.
std::string span_of_tag(const PlainTable& table, const std::string& tag_type) {
  const std::string type = native_type(table.time_kind);
  return " WHERE " + table.tag + " = " + parameter(1, tag_type) + " AND " + table.time +
         " >= " + parameter(2, type) + " AND " + table.time + " <= " + parameter(3, type);
}

}  // namespace

const Statement kFindRelation{"find_relation", R"(
    SELECT c.oid, n.nspname, c.relname, c.relkind IN ('r', 'p', 'm')
    FROM pg_catalog.pg_class AS c JOIN pg_catalog.pg_namespace AS n ON n.oid = c.relnamespace
    WHERE c.relname = $2::name AND c.relkind IN ('r', 'p', 'v', 'm', 'f')
      AND CASE WHEN $1::name = '' THEN pg_catalog.pg_table_is_visible(c.oid)
               ELSE n.nspname = $1::name END)"};

const Statement kColumns{"columns", R"(
    SELECT a.attname, CASE WHEN t.typtype = 'd' THEN base.typname ELSE t.typname END
    FROM pg_catalog.pg_attribute AS a
    JOIN pg_catalog.pg_type AS t ON t.oid = a.atttypid
    LEFT JOIN pg_catalog.pg_type AS base ON base.oid = t.typbasetype
    WHERE a.attrelid = $1::oid AND a.attnum > 0 AND NOT a.attisdropped)"};

const Statement kIndexes{"indexes", R"(
    SELECT (SELECT string_agg(a.attname, ',' ORDER BY place)
            FROM unnest(i.indkey) WITH ORDINALITY AS k (number, place)
            JOIN pg_catalog.pg_attribute AS a ON a.attrelid = i.indrelid AND a.attnum = k.number
            WHERE place <= i.indnkeyatts),
           (SELECT string_agg(a.attname, ',')
            FROM pg_catalog.pg_attribute AS a
            WHERE a.attrelid = i.indrelid AND a.attnum = ANY (i.indkey))
    FROM pg_catalog.pg_index AS i
    WHERE i.indrelid = $1::oid AND i.indisvalid AND i.indpred IS NULL
    ORDER BY i.indnatts DESC)"};

const Statement kFindZone{"find_zone",
                          "SELECT 1 FROM pg_catalog.pg_timezone_names WHERE name = $1::text"};

const Statement kNow{"now", "SELECT (extract(epoch FROM clock_timestamp()) * 1000000)::int8",
                     Rows::one};
const Statement kBegin{"begin", "BEGIN", Rows::none};
const Statement kCommit{"commit", "COMMIT", Rows::none};

// One index scan per key and one round trip per batch: arrays cost the client a sixth of what rows
// cost. Every scan has a lower bound: without one, a dead tag's scan would walk through the whole
// history. array_agg keeps the order of its subquery. Over several tables the scans are merged, so
// that the limit reaches each of them.
Statement read_scans(const ResolvedLayout& layout, const std::vector<std::string>& relations,
                     const std::vector<ScanColumn>& columns) {
  const KeyArrays keys = key_arrays(layout);
  const std::size_t next = layout.key.size() + 1;
  const std::string times = native(layout) + "[]";
  std::string select = "SELECT request.slot, span.times, span.unknown";
  std::string before_columns, before_joins;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const std::string number = std::to_string(k);
    select += ", span.v" + number;
    if (!columns[k].before) continue;
    before_columns += ", b" + number + ".time, b" + number + ".value";
    before_joins += " LEFT JOIN LATERAL (" + before_sql(layout, relations, columns[k].value) +
                    ") AS b" + number + " ON true";
  }
  return {"read_scans",
          select + before_columns + " FROM unnest(" + keys.parameters + parameter(next, times) +
              ", " + parameter(next + 1, times) + ", " + parameter(next + 2, "int8[]") + ", " +
              parameter(next + 3, times) + ") WITH ORDINALITY AS request (" + keys.names +
              "from_time, to_time, max_rows, before_time, slot) CROSS JOIN LATERAL (" +
              span_sql(layout, relations, columns) + ") AS span" + before_joins};
}

Statement newest_rows(const ResolvedLayout& layout, const std::vector<std::string>& relations) {
  const KeyArrays keys = key_arrays(layout);
  const std::size_t next = layout.key.size() + 1;
  const std::string type = native(layout);
  const std::string request =
      layout.key.empty() ? "(SELECT 1::int8 AS slot) AS request"
                         : "unnest(" + keys.parameters.substr(0, keys.parameters.size() - 2) +
                               ") WITH ORDINALITY AS request (" + keys.names + "slot)";
  const Order order = order_of(layout);
  const std::string within = key_is_requested(layout) + layout.time +
                             " >= " + bound_sql(layout, parameter(next, type)) + " AND " +
                             layout.time + " <= " + bound_sql(layout, parameter(next + 1, type));
  return {"newest_rows",
          "SELECT request.slot, newest.time FROM " + request +
              " CROSS JOIN LATERAL (SELECT u.time" + " FROM " +
              all_of(relations, order.columns + time_sql(layout) + " AS time", within) +
              " AS u ORDER BY " + order.newest_first + " LIMIT 1) AS newest"};
}

Statement find_ids(const ResolvedNames& names, bool lower_too) {
  const std::string wanted =
      lower_too ? "ANY (ARRAY[request.name, lower(request.name)])" : "request.name";
  return {"find_ids", ids_sql(names, "n." + names.name + " = " + wanted)};
}

Statement find_ids_in_any_case(const ResolvedNames& names) {
  return {"find_ids_in_any_case",
          ids_sql(names, "lower(n." + names.name + "::text) = lower(request.name)")};
}

Statement ids_of_names(const std::string& relation, const std::string& name,
                       const std::string& id) {
  return {"ids_of_names", "SELECT DISTINCT n." + id + "::text FROM " + relation +
                              " AS n JOIN unnest($1::text[]) AS wanted (name)"
                              " ON lower(n." +
                              name + "::text) = lower(wanted.name)"};
}

Statement list_partitions(const ResolvedPartitions& list, TimeKind kind) {
  const std::string type = native_type(kind);
  return {"list_partitions", "SELECT p." + list.name + "::text, p." + list.start + "::" + type +
                                 ", p." + list.end + "::" + type + " FROM " + list.relation +
                                 " AS p"};
}

Statement explain(const Statement& statement) {
  return {"explain", "EXPLAIN (COSTS off) " + statement.sql};
}

Statement newest_row(const ResolvedLayout& layout, const std::string& relation) {
  return {"newest_row", "SELECT " + time_sql(layout) + " FROM " + relation + " AS h WHERE " +
                            layout.time + " >= " + bound_sql(layout, parameter(1, native(layout))) +
                            " ORDER BY " + layout.time + " DESC LIMIT 1"};
}

Statement try_read(const ResolvedLayout& layout, const std::string& value) {
  std::string keys;
  for (const ResolvedKey& key : layout.key) keys += key.column + ", ";
  return {"try_read",
          "SELECT " + keys + time_sql(layout) + ", " + value + " FROM " + layout.data.sql +
              " AS h LIMIT 0",
          Rows::none};
}

Statement has_rows(const PlainTable& table, const std::string& tag_type) {
  return {"has_rows",
          "SELECT EXISTS (SELECT FROM " + table.relation + span_of_tag(table, tag_type) + ")",
          Rows::one};
}

Statement delete_rows(const PlainTable& table, const std::string& tag_type) {
  return {"delete_rows", "DELETE FROM " + table.relation + span_of_tag(table, tag_type),
          Rows::none};
}

Statement copy_rows(const PlainTable& table) {
  const std::string quality = table.quality.empty() ? "" : ", " + table.quality;
  return {"copy_rows",
          "COPY " + table.relation + " (" + table.tag + ", " + table.time + ", " + table.value +
              quality + ") FROM STDIN",
          Rows::none};
}

Statement create_table(const PlainTable& table) {
  const std::string quality = table.quality.empty() ? "" : ", " + table.quality + " smallint";
  return {"create_table",
          "CREATE TABLE " + table.relation + " (" + table.tag + " text NOT NULL, " + table.time +
              " " + native_type(table.time_kind) + " NOT NULL, " + table.value + " float8" +
              quality + ")",
          Rows::none};
}

// All columns in the index: a window is then read from some 30 pages instead of thousands.
Statement create_index(const PlainTable& table) {
  const std::string quality = table.quality.empty() ? "" : ", " + table.quality;
  return {"create_index",
          "CREATE INDEX ON " + table.relation + " (" + table.tag + ", " + table.time +
              ") INCLUDE (" + table.value + quality + ")",
          Rows::none};
}

}  // namespace loopscope::storage::historian_statements
