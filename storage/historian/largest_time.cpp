#include "storage/historian/largest_time.hpp"

#include "storage/historian/foreign_plan.hpp"
#include "storage/historian/native_time.hpp"
#include "storage/historian/scan_sql.hpp"
#include "storage/historian/statements.hpp"

namespace loopscope::storage {
namespace historian_statements {
namespace {

/// The table of expressions keeps PostgreSQL from making ORDER BY time LIMIT 1 of max(time), which
/// it would send without the limit: the rows of a year would be sorted there.
std::string largest_of(const ResolvedLayout& layout, const std::string& relation,
                       const std::string& within) {
  return "(WITH none AS (SELECT) SELECT max(" + layout.time + ") AS o0 FROM " + relation +
         " AS h WHERE " + within + ")";
}

/// The largest time of each of some keys, before any bound: only its plan counts.
Statement largest_times(const ResolvedLayout& layout) {
  std::string keys, names;
  for (std::size_t part = 0; part < layout.key.size(); ++part) {
    keys += "NULL::" + layout.key[part].type + ", ";
    names += "k" + std::to_string(part) + ", ";
  }
  const std::string bound = bound_sql(layout, parameter(1, native(layout)));
  return {"largest_times",
          "SELECT n.o0 FROM (SELECT " + keys + "1 OFFSET 0) AS request (" + names +
              "one) CROSS JOIN LATERAL (" +
              largest_time(layout, {layout.data.sql},
                           key_is_requested(layout) + layout.time + " < " + bound) +
              ") AS n"};
}

}  // namespace

std::string largest_time(const ResolvedLayout& layout, const std::vector<std::string>& relations,
                         const std::string& within) {
  std::string each;
  for (const std::string& relation : relations)
    each += (each.empty() ? "" : " UNION ALL ") + largest_of(layout, relation, within);
  return "SELECT max(p.o0) AS o0 FROM (" + each + ") AS p";
}

}  // namespace historian_statements

bool asks_for_largest(PqConnection& connection, const ResolvedLayout& layout) {
  // Beside nanoseconds the time alone does not tell which row is the newest.
  if (!layout.foreign || !layout.parameters_elsewhere || !layout.nanos.empty()) return false;
  const Statement plan =
      historian_statements::explain(historian_statements::largest_times(layout), true);
  const std::string bound = native_bound(layout.layout.time_kind, 0, Bound::upper);
  const std::vector<ForeignScan> scans = foreign_scans(connection.run(plan, {bound}));
  return scans.size() == 1 && scans.front().filter.empty() &&
         scans.front().sent.find("SELECT max(") == 0;
}

}  // namespace loopscope::storage
