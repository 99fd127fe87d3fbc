#include "storage/historian/scan_sql.hpp"

#include "storage/historian/native_time.hpp"

namespace loopscope::storage::historian_statements {
namespace {

/// The table of expressions keeps PostgreSQL from making ORDER BY time LIMIT 1 of max(time), which
/// it would send without the limit: the rows of a year would be sorted there.
std::string largest_of(const ResolvedLayout& layout, const std::string& relation,
                       const std::string& within) {
  return "(WITH none AS (SELECT) SELECT max(" + layout.time + ") AS o0 FROM " + relation +
         " AS h WHERE " + within + ")";
}

}  // namespace

std::string native(const ResolvedLayout& layout) {
  return native_type(layout.layout.time_kind);
}

std::string time_sql(const ResolvedLayout& layout, const std::string& time) {
  if (!layout.zone.empty()) return "(" + time + " AT TIME ZONE " + layout.zone + ")";
  return time + "::" + native(layout);
}

std::string time_sql(const ResolvedLayout& layout) {
  if (layout.nanos.empty() || !layout.zone.empty()) return time_sql(layout, layout.time);
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

std::string fenced(const std::string& rows) {
  return "(SELECT * FROM " + rows + " AS every OFFSET 0)";
}

std::string largest_time(const ResolvedLayout& layout, const std::vector<std::string>& relations,
                         const std::string& within) {
  std::string each;
  for (const std::string& relation : relations)
    each += (each.empty() ? "" : " UNION ALL ") + largest_of(layout, relation, within);
  return "SELECT max(p.o0) AS o0 FROM (" + each + ") AS p";
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

std::string has_value(const ResolvedLayout& layout, const std::string& value) {
  return layout.layout.null_is_absent ? " AND " + value + " IS NOT NULL" : "";
}

}  // namespace loopscope::storage::historian_statements
