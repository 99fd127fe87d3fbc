#include "daemon/setup/recognise_layouts.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "daemon/setup/table_layout.hpp"
#include "daemon/setup/vendor_layouts.hpp"
#include "daemon/text/failure.hpp"

namespace loopscope::daemon {
namespace {

using storage::SeenTable;

bool is_called(const std::string& schema, const std::string& name, const std::string& wish) {
  return wish.empty() || wish == schema + "." + name || wish == name;
}

void require_table(const std::vector<SeenTable>& tables, const std::string& wish) {
  std::vector<std::string> names;
  for (const SeenTable& table : tables) {
    if (is_called(table.schema, table.name, wish)) return;
    if (names.size() < 20) names.push_back(table.schema + "." + table.name);
  }
  throw Failure(ExitCode::usage, fmt::format("the historian has no table {}", wish),
                names.empty() ? "its database has no tables at all: check dbname"
                              : fmt::format("it has {}", fmt::join(names, ", ")));
}

bool is_wanted(const LayoutCandidate& candidate, const LayoutWishes& wishes) {
  const bool preset = wishes.preset.empty() || wishes.preset == candidate.historian.preset;
  return preset && std::ranges::any_of(candidate.tables, [&](const storage::TableName& table) {
           return is_called(table.schema, table.table, wishes.table);
         });
}

}  // namespace

std::vector<LayoutCandidate> recognise_layouts(const std::vector<SeenTable>& tables,
                                               const LayoutWishes& wishes) {
  if (!wishes.table.empty()) require_table(tables, wishes.table);
  std::vector<LayoutCandidate> found = vendor_layouts(tables);
  std::erase_if(found, [&](const auto& candidate) { return !is_wanted(candidate, wishes); });
  if (!found.empty()) return found;
  for (const SeenTable& table : tables) {
    if (!is_called(table.schema, table.name, wishes.table)) continue;
    if (auto candidate = table_layout(table, tables, wishes))
      found.push_back(*std::move(candidate));
  }
  return found;
}

std::string describe(const LayoutCandidate& candidate) {
  const double rows = candidate.data.rows;
  const std::string about = rows < 1.0 ? ""
                            : rows < 20'000
                                ? fmt::format(", about {:.0f} rows", rows)
                                : fmt::format(", about {:.2g} million rows", rows / 1e6);
  return fmt::format("{}: preset {}, {}{}", candidate.historian.table, candidate.historian.preset,
                     candidate.seen, about);
}

}  // namespace loopscope::daemon
