#include "storage/historian/scan_statements.hpp"

#include "storage/historian/row_before.hpp"
#include "storage/historian/scan.hpp"
#include "storage/historian/scan_sql.hpp"

namespace loopscope::storage::historian_statements {
namespace {

/// "h"."key"::text, ...
std::string keys_as_text(const ResolvedLayout& layout) {
  std::string sql;
  for (const ResolvedKey& key : layout.key) sql += key.column + "::text, ";
  return sql;
}

/// Rows to be ordered as order_of() says: nanoseconds are an expression, which mysql_fdw cannot
/// order by.
std::string in_order(const ResolvedLayout& layout, const std::string& rows) {
  return layout.foreign && !layout.nanos.empty() ? fenced(rows) : rows;
}

/// A row of a scan, and what many of them are put together to.
struct ScanRow {
  std::string columns;  ///< time, known (where the quality tells), v0, v1, ...
  std::string arrays;   ///< times, unknown, v0, v1, ... of rows x
};

ScanRow scan_row(const ResolvedLayout& layout, const std::vector<ScanColumn>& columns) {
  ScanRow row{time_sql(layout) + " AS time", "array_agg(x.time) AS times, "};
  if (layout.quality.known.empty()) {
    row.arrays += "0::int8 AS unknown";
  } else {
    row.columns += ", " + layout.quality.known + " AS known";
    row.arrays += "count(*) FILTER (WHERE x.known IS NOT TRUE) AS unknown";
  }
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const std::string name = "v" + std::to_string(k);
    row.columns += ", " + columns[k].value + " AS " + name;
    row.arrays += ", array_agg(x." + name + ") AS " + name;
  }
  return row;
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

/// The parts of one key as parameters from $1 on: "$1::text AS k0, 1::int8 AS slot".
std::string one_key(const ResolvedLayout& layout) {
  std::string key;
  for (std::size_t part = 0; part < layout.key.size(); ++part)
    key += parameter(part + 1, layout.key[part].type) + " AS k" + std::to_string(part) + ", ";
  return key + "1::int8 AS slot";
}

/// One request, which PostgreSQL makes constants of before it asks: of what is found at run time
/// mysql_fdw drops the fraction of a second, a conversion to local time it does not send at all,
/// and tds_fdw sends no value.
std::string request_elsewhere(const ResolvedLayout& layout) {
  std::size_t next = layout.key.size() + 1;
  std::string columns = one_key(layout) + ", " + parameter(next++, "int8") + " AS max_rows, ";
  columns += parameter(next++, native(layout)) + " AS from_time, ";
  columns += parameter(next++, native(layout)) + " AS to_time";
  for (std::size_t k = 0; k < kGrowingSpans_us.size(); ++k)
    columns += ", " + parameter(next++, native(layout)) + " AS before_" + std::to_string(k);
  return "(SELECT " + columns + ") AS request";
}

/// The scans that read_scans() is asked for.
std::string requests_sql(const ResolvedLayout& layout) {
  if (layout.foreign) return request_elsewhere(layout);
  const KeyArrays keys = key_arrays(layout);
  const std::size_t next = layout.key.size() + 1;
  const std::string times = native(layout) + "[]";
  return "unnest(" + keys.parameters + parameter(next, times) + ", " + parameter(next + 1, times) +
         ", " + parameter(next + 2, "int8[]") + ", " + parameter(next + 3, times) +
         ") WITH ORDINALITY AS request (" + keys.names +
         "from_time, to_time, max_rows, before_time, slot)";
}

/// One table of arrays per request: its span.
std::string span_sql(const ResolvedLayout& layout, const std::vector<std::string>& relations,
                     const std::vector<ScanColumn>& columns) {
  const Order order = order_of(layout);
  const ScanRow row = scan_row(layout, columns);
  const std::string within = key_is_requested(layout) + layout.time +
                             " >= " + bound_sql(layout, "request.from_time") + " AND " +
                             layout.time + " <= " + bound_sql(layout, "request.to_time") +
                             has_value(layout, columns.front().value);  // before the limit
  return "SELECT " + row.arrays + " FROM (SELECT u.* FROM " +
         in_order(layout, all_of(relations, order.columns + row.columns, within)) +
         " AS u ORDER BY " + order.newest_first + " LIMIT request.max_rows) AS x";
}

/// The keys that newest_rows() is asked for.
std::string keys_sql(const ResolvedLayout& layout) {
  if (layout.foreign || layout.key.empty()) return "(SELECT " + one_key(layout) + ") AS request";
  const KeyArrays keys = key_arrays(layout);
  return "unnest(" + keys.parameters.substr(0, keys.parameters.size() - 2) +
         ") WITH ORDINALITY AS request (" + keys.names + "slot)";
}

std::string newest_first(const ResolvedLayout& layout, const std::vector<std::string>& relations,
                         const std::string& within) {
  const Order order = order_of(layout);
  return "SELECT u.time FROM " +
         in_order(layout,
                  all_of(relations, order.columns + time_sql(layout) + " AS time", within)) +
         " AS u ORDER BY " + order.newest_first + " LIMIT 1";
}

std::string largest(const ResolvedLayout& layout, const std::vector<std::string>& relations,
                    const std::string& within) {
  return "SELECT " + time_sql(layout, "n.o0") + " AS time FROM (" +
         largest_time(layout, relations, within) + ") AS n WHERE n.o0 IS NOT NULL";
}

std::string values_of_span(const std::vector<ScanColumn>& columns) {
  std::string names;
  for (std::size_t k = 0; k < columns.size(); ++k) names += ", span.v" + std::to_string(k);
  return names;
}

}  // namespace

// One index scan per key and one round trip per batch: arrays cost the client a sixth of what rows
// cost. Every scan has a lower bound: without one, a dead tag's scan would walk through the whole
// history. array_agg keeps the order of its subquery. Over several tables the scans are merged, so
// that the limit reaches each of them.
Statement read_scans(const ResolvedLayout& layout, const std::vector<std::string>& relations,
                     const std::vector<ScanColumn>& columns) {
  const RowsBefore before = rows_before(layout, relations, columns);
  return {"read_scans", "SELECT request.slot, span.times, span.unknown" + values_of_span(columns) +
                            before.columns + " FROM " + requests_sql(layout) +
                            " CROSS JOIN LATERAL (" + span_sql(layout, relations, columns) +
                            ") AS span" + before.joins};
}

// One pass over the table for all keys. The order of its rows is that of the table, so no index
// tells which are the newest: the limit is one for all, and only says that there are too many.
HeapOrderStatements read_in_heap_order(const ResolvedLayout& layout,
                                       const std::vector<std::string>& relations,
                                       const std::vector<ScanColumn>& columns) {
  const ResolvedKey& key = layout.key.front();
  const std::string keys = parameter(1, key.type + "[]"), type = native(layout);
  const ScanRow row = scan_row(layout, columns);
  const RowsBefore before = rows_before(layout, relations, columns);
  const std::string within = key.column + " = ANY (" + keys + ") AND " + layout.time +
                             " >= " + bound_sql(layout, parameter(2, type)) + " AND " +
                             layout.time + " <= " + bound_sql(layout, parameter(3, type)) +
                             has_value(layout, columns.front().value);
  const std::string span = "SELECT x.k0, " + row.arrays + " FROM (SELECT u.* FROM " +
                           all_of(relations, key.column + " AS k0, " + row.columns, within) +
                           " AS u LIMIT " + parameter(4, "int8") + ") AS x GROUP BY x.k0";
  return {{"explain_heap_order", "EXPLAIN " + span},
          {"read_in_heap_order",
           "SELECT request.slot, span.times, coalesce(span.unknown, 0)" + values_of_span(columns) +
               before.columns + " FROM (SELECT *, " + parameter(2, type) +
               " AS from_time FROM unnest(" + keys + ", " + parameter(5, type + "[]") +
               ") WITH ORDINALITY AS r (k0, before_time, slot)) AS request LEFT JOIN (" + span +
               ") AS span ON span.k0 = request.k0" + before.joins}};
}

Statement newest_rows(const ResolvedLayout& layout, const std::vector<std::string>& relations,
                      const std::string& column) {
  const std::size_t next = layout.key.size() + 1;
  const std::string type = native(layout), request = keys_sql(layout);
  std::string within = key_is_requested(layout) + layout.time +
                       " >= " + bound_sql(layout, parameter(next, type)) + " AND " + layout.time +
                       " <= " + bound_sql(layout, parameter(next + 1, type));
  if (!column.empty()) within += " AND " + column + " IS NOT NULL";
  const bool largest_tells = layout.largest_elsewhere && column.empty();
  return {"newest_rows", "SELECT request.slot, newest.time FROM " + request +
                             " CROSS JOIN LATERAL (" +
                             (largest_tells ? largest(layout, relations, within)
                                            : newest_first(layout, relations, within)) +
                             ") AS newest"};
}

Statement newest_row(const ResolvedLayout& layout, const std::string& relation) {
  return {"newest_row", "SELECT " + keys_as_text(layout) + time_sql(layout) + " FROM " + relation +
                            " AS h WHERE " + layout.time +
                            " >= " + bound_sql(layout, parameter(1, native(layout))) + " AND " +
                            layout.time + " <= " + bound_sql(layout, parameter(2, native(layout))) +
                            " ORDER BY " + layout.time + " DESC LIMIT 1"};
}

Statement times_of_key(const ResolvedLayout& layout, const std::string& relation) {
  std::string within;
  std::size_t next = 1;
  for (const ResolvedKey& key : layout.key)
    within += key.column + " = " + parameter(next++, key.type) + " AND ";
  const std::string from = parameter(next, native(layout)),
                    to = parameter(next + 1, native(layout));
  return {"times_of_key", "SELECT " + time_sql(layout) + " FROM " + relation + " AS h WHERE " +
                              within + layout.time + " >= " + bound_sql(layout, from) + " AND " +
                              layout.time + " <= " + bound_sql(layout, to) + " ORDER BY " +
                              layout.time + " DESC LIMIT " + parameter(next + 2, "int8")};
}

Statement any_row(const ResolvedLayout& layout, const std::string& relation) {
  std::string present;
  for (const ResolvedKey& key : layout.key) present += key.column + " IS NOT NULL AND ";
  return {"any_row", "SELECT " + keys_as_text(layout) + time_sql(layout) + " FROM " + relation +
                         " AS h WHERE " + present + layout.time + " IS NOT NULL LIMIT 1"};
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
