#include "daemon/setup/table_layout.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "config/historian_presets.hpp"
#include "daemon/setup/column_roles.hpp"
#include "daemon/setup/preset_fit.hpp"
#include "daemon/setup/vendor_layouts.hpp"

namespace loopscope::daemon {
namespace {

using storage::SeenColumn;
using storage::SeenTable;

std::string full_name(const SeenTable& table) {
  return table.schema + "." + table.name;
}

const SeenColumn* find_column(const SeenTable& table, const std::string& name) {
  const auto found = std::ranges::find(table.columns, name, &SeenColumn::name);
  return found == table.columns.end() ? nullptr : &*found;
}

/// Telegraf's times are without a zone, its columns of tags have that comment or are the host.
bool looks_like_telegraf(const SeenTable& table, const ColumnRoles& roles) {
  return roles.time->type == "timestamp" || find_column(table, "host") != nullptr ||
         std::ranges::any_of(table.columns,
                             [](const SeenColumn& column) { return column.comment == "tag"; });
}

/// Narrow where a name says which column is the value, or where there is but one.
std::string likely_preset(const SeenTable& table, const ColumnRoles& roles) {
  const bool has_key = roles.tag || !roles.possible_tags.empty();
  if (roles.value && has_key &&
      (rank_of(ColumnRole::value, roles.value->name) || roles.numbers.empty()))
    return "narrow";
  const std::size_t numbers = roles.numbers.size() + (roles.value ? 1 : 0);
  if (numbers < 2) return "";
  if (!has_key) return "wide";
  return looks_like_telegraf(table, roles) ? "telegraf" : "loop_row";
}

/// A table that has the same number beside a name.
bool gives_names(const SeenTable& names, const SeenTable& data, const SeenColumn& key) {
  if (names.schema != data.schema || names.name == data.name || !find_name_column(names))
    return false;
  const SeenColumn* same = find_column(names, key.name);
  const SeenColumn* id = same != nullptr ? same : find_column(names, "id");
  return id != nullptr && kind_of(*id) == kind_of(key) && names.columns.size() <= 12 &&
         std::ranges::none_of(names.columns, [](const SeenColumn& column) {
           return column.type == "float8" || column.type == "float4";
         });
}

class TableLayout {
 public:
  TableLayout(const SeenTable& table, const std::vector<SeenTable>& tables, ColumnRoles roles,
              const std::string& preset)
      : table_(table), tables_(tables), roles_(std::move(roles)) {
    candidate_.historian = config::historian_preset(preset);
    candidate_.historian.table = full_name(table);
    candidate_.data = table;
    candidate_.tables.push_back({table.schema, table.name});
    candidate_.readable = table.readable;
  }

  LayoutCandidate make() {
    fill_times();
    if (candidate_.historian.layout != "wide") fill_key();
    if (candidate_.historian.layout == "narrow") {
      fill_value();
    } else {
      if (roles_.value) roles_.numbers.insert(roles_.numbers.begin(), roles_.value->name);
      say("values in " + listed(roles_.numbers));
    }
    return candidate_;
  }

 private:
  void say(const std::string& words) {
    candidate_.seen += (candidate_.seen.empty() ? "" : ", ") + words;
  }

  void fill_times() {
    config::HistorianSettings& historian = candidate_.historian;
    historian.time_column = roles_.time->name;
    const std::string& type = roles_.time->type;
    if (type == "timestamptz") historian.time_kind = "timestamptz";
    if (type == "timestamp") historian.time_kind = "timestamp_utc";
    if (kind_of(*roles_.time) == ColumnKind::real) historian.time_kind = "epoch_s_float";
    if (kind_of(*roles_.time) == ColumnKind::whole) historian.time_kind = "epoch_ms";
    say(fmt::format("time in {} ({})", historian.time_column, type));
  }

  void fill_key() {
    const bool narrow = candidate_.historian.layout == "narrow";
    if (!roles_.tag) {
      candidate_.open = fmt::format("which column names the {}: --tag-column with one of {}",
                                    narrow ? "tag" : "loop", listed(roles_.possible_tags));
      return;
    }
    candidate_.historian.tag_column = roles_.tag->name;
    say(fmt::format("{} in {}", narrow ? "tag" : "loop", roles_.tag->name));
    if (kind_of(*roles_.tag) != ColumnKind::text) fill_names();
  }

  void fill_names() {
    std::vector<const SeenTable*> found;
    for (const SeenTable& names : tables_) {
      if (gives_names(names, table_, *roles_.tag)) found.push_back(&names);
    }
    if (found.size() != 1) return;
    const SeenTable& names = *found.front();
    config::HistorianSettings& historian = candidate_.historian;
    historian.tag_table = full_name(names);
    historian.tag_name_column = find_name_column(names)->name;
    historian.tag_id_column =
        find_column(names, roles_.tag->name) != nullptr ? roles_.tag->name : "id";
    candidate_.tables.push_back({names.schema, names.name});
    candidate_.readable = candidate_.readable && names.readable;
    say(fmt::format("its name in {}.{}", historian.tag_table, historian.tag_name_column));
  }

  void fill_value() {
    config::HistorianSettings& historian = candidate_.historian;
    historian.value_column = roles_.value->name;
    say("value in " + historian.value_column);
    historian.quality_column = roles_.quality ? roles_.quality->name : "";
    if (!roles_.quality) historian.quality_rule = "none";
    if (roles_.quality) say("quality in " + historian.quality_column);
  }

  const SeenTable& table_;
  const std::vector<SeenTable>& tables_;
  ColumnRoles roles_;
  LayoutCandidate candidate_;
};

}  // namespace

std::optional<LayoutCandidate> table_layout(const SeenTable& table,
                                            const std::vector<SeenTable>& tables,
                                            const LayoutWishes& wishes) {
  if (!wishes.preset.empty() && is_vendor(wishes.preset)) return std::nullopt;
  ColumnRoles roles = find_roles(table, wishes);
  if (!roles.time) return std::nullopt;
  const std::string preset = wishes.preset.empty() ? likely_preset(table, roles) : wishes.preset;
  if (preset.empty() || !what_is_missing(roles, preset).empty()) return std::nullopt;
  return TableLayout(table, tables, std::move(roles), preset).make();
}

}  // namespace loopscope::daemon
