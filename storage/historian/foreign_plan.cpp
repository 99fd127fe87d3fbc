#include "storage/historian/foreign_plan.hpp"

#include <optional>

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

}  // namespace loopscope::storage
