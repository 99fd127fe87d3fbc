#include "storage/historian/scan_statements.hpp"

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
  std::string within = key_is_requested(layout) + layout.time +
                       " >= " + bound_sql(layout, "request.from_time") + " AND " + layout.time +
                       " <= " + bound_sql(layout, "request.to_time");
  // Before the limit: rows of other fields must not take its place. Such scans have one column.
  if (layout.layout.null_is_absent) within += " AND " + columns.front().value + " IS NOT NULL";
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
  // As in a series: of rows with one time the largest value counts where nothing tells them apart.
  const std::string ties = layout.tiebreak.empty() ? ", u.value DESC NULLS LAST" : "";
  return "SELECT u.time, u.value FROM " + all_of(relations, row, within) + " AS u ORDER BY " +
         order.newest_first + ties + " LIMIT 1";
}

}  // namespace

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

Statement newest_rows(const ResolvedLayout& layout, const std::vector<std::string>& relations,
                      const std::string& column) {
  const KeyArrays keys = key_arrays(layout);
  const std::size_t next = layout.key.size() + 1;
  const std::string type = native(layout);
  const std::string request =
      layout.key.empty() ? "(SELECT 1::int8 AS slot) AS request"
                         : "unnest(" + keys.parameters.substr(0, keys.parameters.size() - 2) +
                               ") WITH ORDINALITY AS request (" + keys.names + "slot)";
  const Order order = order_of(layout);
  std::string within = key_is_requested(layout) + layout.time +
                       " >= " + bound_sql(layout, parameter(next, type)) + " AND " + layout.time +
                       " <= " + bound_sql(layout, parameter(next + 1, type));
  if (!column.empty()) within += " AND " + column + " IS NOT NULL";
  return {"newest_rows",
          "SELECT request.slot, newest.time FROM " + request +
              " CROSS JOIN LATERAL (SELECT u.time" + " FROM " +
              all_of(relations, order.columns + time_sql(layout) + " AS time", within) +
              " AS u ORDER BY " + order.newest_first + " LIMIT 1) AS newest"};
}

Statement newest_row(const ResolvedLayout& layout, const std::string& relation) {
  return {"newest_row", "SELECT " + time_sql(layout) + " FROM " + relation + " AS h WHERE " +
                            layout.time + " >= " + bound_sql(layout, parameter(1, native(layout))) +
                            " AND " + layout.time +
                            " <= " + bound_sql(layout, parameter(2, native(layout))) +
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

}  // namespace loopscope::storage::historian_statements
