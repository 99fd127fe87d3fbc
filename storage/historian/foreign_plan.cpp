#include "storage/historian/foreign_plan.hpp"

#include <optional>

#include "storage/historian/native_time.hpp"
#include "storage/historian/scan_sql.hpp"
#include "storage/historian/statements.hpp"
#include "storage/utf8.hpp"

namespace loopscope::storage {
namespace {

/// What is sent, as mysql_fdw and tds_fdw, postgres_fdw and oracle_fdw say it.
constexpr const char* kSent[] = {"Remote query: ", "Remote SQL: ", "Oracle query: "};

std::optional<std::string> after(const std::string& line, const std::string& words) {
  const std::size_t at = line.find_first_not_of(' ');
  if (at == std::string::npos || line.compare(at, words.size(), words) != 0) return std::nullopt;
  return make_storable(line.substr(at + words.size()));
}

/// The first line of a plan is a node without an arrow.
bool is_node(const std::string& line, int row) {
  return row == 0 || line.find("->  ") != std::string::npos;
}

/// The largest time of each of some keys, before any bound: only its plan counts.
Statement largest_times(const ResolvedLayout& layout) {
  std::string keys, names;
  for (std::size_t part = 0; part < layout.key.size(); ++part) {
    keys += "NULL::" + layout.key[part].type + ", ";
    names += "k" + std::to_string(part) + ", ";
  }
  const std::string bound = historian_statements::bound_sql(
      layout, historian_statements::parameter(1, historian_statements::native(layout)));
  return {"largest_times",
          "SELECT n.o0 FROM (SELECT " + keys + "1 OFFSET 0) AS request (" + names +
              "one) CROSS JOIN LATERAL (" +
              historian_statements::largest_time(
                  layout, {layout.data.sql},
                  historian_statements::key_is_requested(layout) + layout.time + " < " + bound) +
              ") AS n"};
}

}  // namespace

std::vector<ForeignScan> foreign_scans(const PqRows& plan) {
  std::vector<ForeignScan> scans;
  bool inside = false;
  for (int row = 0; row < plan.size(); ++row) {
    const std::string line = plan.text(row, 0);
    if (is_node(line, row)) {
      inside = line.find("Foreign Scan") != std::string::npos;
      if (inside) scans.emplace_back();
    }
    if (!inside) continue;
    for (const char* words : kSent) {
      if (auto sent = after(line, words)) scans.back().sent = *std::move(sent);
    }
    if (auto filter = after(line, "Filter: ")) scans.back().filter = *std::move(filter);
  }
  return scans;
}

bool asks_for_largest(PqConnection& connection, const ResolvedLayout& layout) {
  // Beside nanoseconds the time alone does not tell which row is the newest.
  if (!layout.foreign || !layout.parameters_elsewhere || !layout.nanos.empty()) return false;
  const Statement plan = historian_statements::explain(largest_times(layout), true);
  const std::string bound = native_bound(layout.layout.time_kind, 0, Bound::upper);
  const std::vector<ForeignScan> scans = foreign_scans(connection.run(plan, {bound}));
  return scans.size() == 1 && scans.front().filter.empty() &&
         scans.front().sent.find("SELECT max(") == 0;
}

}  // namespace loopscope::storage
