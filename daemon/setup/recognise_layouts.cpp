#include "daemon/setup/recognise_layouts.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "daemon/setup/preset_fit.hpp"
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

bool has_wished(const SeenTable& table, const std::string& wish) {
  return wish.empty() ||
         std::ranges::find(table.columns, wish, &storage::SeenColumn::name) != table.columns.end();
}

bool has_all_wished(const SeenTable& table, const LayoutWishes& wishes) {
  return has_wished(table, wishes.tag_column) && has_wished(table, wishes.time_column) &&
         has_wished(table, wishes.value_column) && has_wished(table, wishes.quality_column);
}

/// The tables that somebody may mean: where he names columns but no table, those that have them.
std::vector<SeenTable> meant_tables(const std::vector<SeenTable>& tables,
                                    const LayoutWishes& wishes) {
  std::vector<SeenTable> meant, with_columns;
  for (const SeenTable& table : tables) {
    if (!is_called(table.schema, table.name, wishes.table)) continue;
    meant.push_back(table);
    if (has_all_wished(table, wishes)) with_columns.push_back(table);
  }
  return with_columns.empty() ? meant : with_columns;
}

std::vector<LayoutCandidate> find_layouts(const std::vector<SeenTable>& tables,
                                          const LayoutWishes& wishes) {
  std::vector<LayoutCandidate> found = vendor_layouts(tables);
  std::erase_if(found, [&](const auto& candidate) { return !is_wanted(candidate, wishes); });
  if (!found.empty()) return found;
  for (const SeenTable& table : meant_tables(tables, wishes)) {
    if (auto candidate = table_layout(table, tables, wishes))
      found.push_back(*std::move(candidate));
  }
  return found;
}

/// Why the preset that was said reads none of the tables that may be meant, a reason for each.
std::string misfit(const std::vector<SeenTable>& tables, const LayoutWishes& wishes,
                   const std::vector<LayoutCandidate>& fitting) {
  if (is_vendor(wishes.preset)) {
    const std::string missing = missing_of_vendor(tables, wishes.preset);
    return missing.empty() ? "its tables do not include " + wishes.table : missing;
  }
  std::vector<std::string> reasons;
  for (const SeenTable& table : meant_tables(tables, wishes)) {
    const bool asked = !wishes.table.empty() ||
                       std::ranges::any_of(fitting, [&](const LayoutCandidate& candidate) {
                         return candidate.historian.table == table.schema + "." + table.name;
                       });
    if (!asked) continue;
    reasons.push_back(fmt::format("{}.{} has {}", table.schema, table.name,
                                  what_is_missing(find_roles(table, wishes), wishes.preset)));
  }
  return fmt::format("{}", fmt::join(reasons, "; "));
}

/// Nothing is said where no table looks like a history at all.
void refuse_preset(const std::vector<SeenTable>& tables, const LayoutWishes& wishes) {
  LayoutWishes without = wishes;
  without.preset.clear();
  const std::vector<LayoutCandidate> fitting = find_layouts(tables, without);
  const std::string why = misfit(tables, wishes, fitting);
  const bool asked = !wishes.table.empty() || is_vendor(wishes.preset);
  if (why.empty() || (fitting.empty() && !asked)) return;
  std::vector<std::string> options;
  for (const LayoutCandidate& candidate : fitting) {
    options.push_back(fmt::format("--preset {} --table {}", candidate.historian.preset,
                                  candidate.historian.table));
  }
  throw Failure(ExitCode::usage, fmt::format("--preset {} does not fit: {}", wishes.preset, why),
                options.empty()
                    ? "no other preset fits either; config/HISTORIANS.md says what each "
                      "one needs"
                    : "what fits: " + listed(options));
}

}  // namespace

std::vector<LayoutCandidate> recognise_layouts(const std::vector<SeenTable>& tables,
                                               const LayoutWishes& wishes) {
  if (!wishes.table.empty()) require_table(tables, wishes.table);
  std::vector<LayoutCandidate> found = find_layouts(tables, wishes);
  if (found.empty() && !wishes.preset.empty()) refuse_preset(tables, wishes);
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
