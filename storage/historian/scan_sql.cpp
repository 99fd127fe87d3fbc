#include "storage/historian/scan_sql.hpp"

#include "storage/historian/native_time.hpp"

namespace loopscope::storage::historian_statements {
namespace {

/// The newest row of one column before each request's span.
std::string before_sql(const ResolvedLayout& layout, const std::vector<std::string>& relations,
                       const std::string& value) {
  const Order order = order_of(layout);
  std::string within = key_is_requested(layout) + layout.time +
                       " >= " + bound_sql(layout, "request.before_time") + " AND " + layout.time +
                       " < " + bound_sql(layout, "request.from_time");
  within += has_value(layout, value);
  const std::string row = order.columns + time_sql(layout) + " AS time, " + value + " AS value";
  // As in a series: of rows with one time the largest value counts where nothing tells them apart.
  const std::string ties = layout.tiebreak.empty() ? ", u.value DESC NULLS LAST" : "";
  return "SELECT u.time, u.value FROM " + all_of(relations, row, within) + " AS u ORDER BY " +
         order.newest_first + ties + " LIMIT 1";
}

}  // namespace

std::string native(const ResolvedLayout& layout) {
  return native_type(layout.layout.time_kind);
}

std::string time_sql(const ResolvedLayout& layout) {
  if (!layout.zone.empty()) return "(" + layout.time + " AT TIME ZONE " + layout.zone + ")";
  if (layout.nanos.empty()) return layout.time + "::" + native(layout);
  return "(date_trunc('second', " + layout.time + ") + (" + layout.nanos +
         " / 1000) * interval '1 microsecond')";
}

std::string bound_sql(const ResolvedLayout& layout, const std::string& bound) {
  return layout.zone.empty() ? bound : "(" + bound + " AT TIME ZONE " + layout.zone + ")";
}

std::string parameter(std::size_t number, const std::string& type) {
  return "$" + std::to_string(number) + "::" + type;
}

std::string key_is_requested(const ResolvedLayout& layout) {
  std::string sql;
  for (std::size_t part = 0; part < layout.key.size(); ++part) {
    sql += layout.key[part].column + " = request.k" + std::to_string(part) + " AND ";
  }
  return sql;
}

std::string all_of(const std::vector<std::string>& relations, const std::string& what,
                   const std::string& condition) {
  std::string sql;
  for (const std::string& relation : relations) {
    sql += (sql.empty() ? "(" : " UNION ALL ");
    sql += "SELECT " + what + " FROM " + relation + " AS h WHERE " + condition;
  }
  return sql + ")";
}

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

std::string has_value(const ResolvedLayout& layout, const std::string& value) {
  return layout.layout.null_is_absent ? " AND " + value + " IS NOT NULL" : "";
}

RowsBefore rows_before(const ResolvedLayout& layout, const std::vector<std::string>& relations,
                       const std::vector<ScanColumn>& columns) {
  RowsBefore before;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (!columns[k].before) continue;
    const std::string name = "b" + std::to_string(k);
    before.columns += ", " + name + ".time, " + name + ".value";
    before.joins += " LEFT JOIN LATERAL (" + before_sql(layout, relations, columns[k].value) +
                    ") AS " + name + " ON true";
  }
  return before;
}

}  // namespace loopscope::storage::historian_statements
