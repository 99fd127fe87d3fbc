#include "daemon/setup/preset_fit.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vector>

namespace loopscope::daemon {
namespace {

constexpr std::size_t kMostNamed = 6;

std::vector<std::string> values_of(const ColumnRoles& roles) {
  std::vector<std::string> names = roles.numbers;
  if (roles.value) names.insert(names.begin(), roles.value->name);
  return names;
}

std::string missing_key(const ColumnRoles& roles, std::string_view names_what) {
  if (roles.tag || !roles.possible_tags.empty()) return {};
  return fmt::format("no column that names the {} (--tag-column)", names_what);
}

std::string missing_value(const ColumnRoles& roles) {
  if (roles.value) return {};
  if (roles.numbers.empty()) return "no column of values (--value-column)";
  return fmt::format("no one column of values (--value-column; it has {})", listed(roles.numbers));
}

/// A loop's setpoint, process variable, output: one number a row is a tag's.
std::string missing_values(const ColumnRoles& roles) {
  const std::vector<std::string> values = values_of(roles);
  if (values.size() > 1) return {};
  const std::string columns = "columns for a loop's sp, pv and op";
  return values.empty() ? "no " + columns : fmt::format("no {}, only {}", columns, values.front());
}

/// A row of a wide table holds every tag, so nothing in it says whose it is.
std::string missing_columns_of_tags(const ColumnRoles& roles) {
  const bool named = roles.tag && (roles.tag->comment == "tag" ||
                                   rank_of(ColumnRole::tag, roles.tag->name).has_value());
  if (named) return fmt::format("no column for each tag: {} says whose a row is", roles.tag->name);
  return values_of(roles).empty() ? "no column for each tag: none holds numbers" : "";
}

}  // namespace

std::string what_is_missing(const ColumnRoles& roles, std::string_view preset) {
  std::vector<std::string> missing;
  if (!roles.time) missing.emplace_back("no column of times (--time-column)");
  if (preset == "narrow") {
    missing.push_back(missing_key(roles, "tag"));
    missing.push_back(missing_value(roles));
  } else if (preset == "wide") {
    missing.push_back(missing_columns_of_tags(roles));
  } else {
    missing.push_back(missing_key(roles, "loop"));
    missing.push_back(missing_values(roles));
  }
  std::erase(missing, "");
  return fmt::format("{}", fmt::join(missing, ", "));
}

std::string listed(std::vector<std::string> names) {
  const std::size_t all = names.size();
  names.resize(std::min(all, kMostNamed));
  return fmt::format("{}{}", fmt::join(names, ", "), all > kMostNamed ? ", ..." : "");
}

}  // namespace loopscope::daemon
