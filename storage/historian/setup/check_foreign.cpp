#include "storage/historian/setup/check_foreign.hpp"

#include <optional>
#include <string>

#include "storage/utf8.hpp"

namespace loopscope::storage {
namespace {

/// What is sent, as mysql_fdw and tds_fdw, postgres_fdw and oracle_fdw say it.
constexpr const char* kSent[] = {"Remote query: ", "Remote SQL: ", "Oracle query: "};

/// A node of a plan that reads a foreign table.
struct ForeignScan {
  std::string sent;    ///< empty = its wrapper does not tell
  std::string filter;  ///< conditions that are left to PostgreSQL; empty = none
};

std::optional<std::string> after(const std::string& line, const std::string& words) {
  const std::size_t at = line.find_first_not_of(' ');
  if (at == std::string::npos || line.compare(at, words.size(), words) != 0) return std::nullopt;
  return make_storable(line.substr(at + words.size()));
}

std::vector<ForeignScan> foreign_scans(const PqRows& plan) {
  std::vector<ForeignScan> scans;
  bool inside = false;
  for (int row = 0; row < plan.size(); ++row) {
    const std::string line = plan.text(row, 0);
    if (line.find("->  ") != std::string::npos) {
      inside = line.find("->  Foreign Scan") != std::string::npos;
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

Finding conditions(const std::vector<ForeignScan>& scans, const std::string& relation) {
  for (const ForeignScan& scan : scans) {
    if (scan.filter.empty()) continue;
    return {true,
            "the other server sends rows that are thrown away here, by " + scan.filter + ", " +
                relation,
            "declare the columns of the foreign table with the types that they have there "
            "(timestamp for DATETIME), and keep conversions of tag and time out of views",
            true};
  }
  return {true, "tag and times of a window are looked up by the other server, " + relation, "",
          false};
}

Finding limit(const std::vector<ForeignScan>& scans, const std::string& relation) {
  const std::string& sent = scans.front().sent;
  if (sent.find(" LIMIT ") != std::string::npos || sent.find(" TOP ") != std::string::npos)
    return {true, "for a window the other server is asked: " + sent + ", " + relation, "", false};
  return {true,
          "the other server sends every row of a window's span, which is ordered and cut here: " +
              (sent.empty() ? "its wrapper does not say what it sends" : sent) + ", " + relation,
          "no harm where a window's span holds no more rows than the window wants", false};
}

}  // namespace

std::vector<Finding> check_foreign(const PqRows& plan, const std::string& relation) {
  const std::vector<ForeignScan> scans = foreign_scans(plan);
  // Every partition that a plan could have was left out.
  if (scans.empty()) return {};
  return {conditions(scans, relation), limit(scans, relation)};
}

}  // namespace loopscope::storage
