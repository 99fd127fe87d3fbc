#include "daemon/setup/vendor_layouts.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>
#include <set>
#include <string_view>

#include "config/historian_presets.hpp"

namespace loopscope::daemon {
namespace {

using config::HistorianSettings;
using storage::SeenColumn;
using storage::SeenTable;
using TextSetting = std::string HistorianSettings::*;

/// A setting that names a table, and the settings that name columns of it.
struct TableSetting {
  TextSetting table;
  std::vector<TextSetting> columns;
};

const std::array kTableSettings = {
    TableSetting{
        &HistorianSettings::partition_table,
        {&HistorianSettings::partition_name_column, &HistorianSettings::partition_start_column,
         &HistorianSettings::partition_end_column}},
    TableSetting{&HistorianSettings::tag_table,
                 {&HistorianSettings::tag_name_column, &HistorianSettings::tag_id_column,
                  &HistorianSettings::tag_order_column, &HistorianSettings::interpolation_column}},
    TableSetting{&HistorianSettings::subtag_table,
                 {&HistorianSettings::subtag_name_column, &HistorianSettings::subtag_id_column}},
    TableSetting{&HistorianSettings::quality_table,
                 {&HistorianSettings::quality_name_column, &HistorianSettings::quality_id_column}},
    TableSetting{&HistorianSettings::table,
                 {&HistorianSettings::tag_column, &HistorianSettings::subtag_column,
                  &HistorianSettings::time_column, &HistorianSettings::nanos_column,
                  &HistorianSettings::value_column, &HistorianSettings::quality_column,
                  &HistorianSettings::tiebreak_column}},
};

storage::TableName split(const std::string& relation) {
  const std::size_t dot = relation.find('.');
  return {relation.substr(0, dot), relation.substr(dot + 1)};
}

/// Where the data lie in tables that a list names, `table` is only said for the time without any.
bool is_needed(const HistorianSettings& historian, const TableSetting& setting) {
  const bool listed = !historian.partition_table.empty();
  return !(historian.*setting.table).empty() &&
         (setting.table != &HistorianSettings::table || !listed);
}

std::set<std::string> columns_of(const HistorianSettings& historian, const TableSetting& setting) {
  std::set<std::string> columns;
  for (const TextSetting column : setting.columns) columns.insert(historian.*column);
  if (setting.table == &HistorianSettings::table)
    columns.insert(historian.more_value_columns.begin(), historian.more_value_columns.end());
  columns.erase("");
  return columns;
}

bool has_columns(const SeenTable& table, const std::set<std::string>& wanted) {
  return std::ranges::all_of(wanted, [&](const std::string& name) {
    return std::ranges::find(table.columns, name, &SeenColumn::name) != table.columns.end();
  });
}

const SeenTable* find_table(const std::vector<SeenTable>& tables, const std::string& schema,
                            const std::string& name) {
  const auto found = std::ranges::find_if(
      tables, [&](const SeenTable& table) { return table.schema == schema && table.name == name; });
  return found == tables.end() ? nullptr : &*found;
}

void take_table(const SeenTable& table, const HistorianSettings& historian,
                LayoutCandidate& candidate) {
  candidate.tables.push_back({table.schema, table.name});
  candidate.readable = candidate.readable && table.readable;
  candidate.data = table;
  if (!historian.partition_table.empty()) candidate.maker = table.owner;
  candidate.seen += (candidate.seen.empty() ? "" : ", ") + table.schema + "." + table.name;
}

/// With all tables in `schema`, or each in its own where that is empty.
std::optional<LayoutCandidate> in_schema(const HistorianSettings& preset, const std::string& schema,
                                         const std::vector<SeenTable>& tables) {
  LayoutCandidate candidate;
  candidate.historian = preset;
  for (const TableSetting& setting : kTableSettings) {
    std::string& relation = candidate.historian.*setting.table;
    if (relation.empty()) continue;
    const storage::TableName usual = split(relation);
    if (!schema.empty()) relation = schema + "." + usual.table;
    if (!is_needed(preset, setting)) continue;
    const SeenTable* table =
        find_table(tables, schema.empty() ? usual.schema : schema, usual.table);
    if (table == nullptr || !has_columns(*table, columns_of(preset, setting))) return std::nullopt;
    take_table(*table, preset, candidate);
  }
  return candidate;
}

/// Newer versions of ThingsBoard call their dictionary otherwise.
std::vector<HistorianSettings> variants_of(std::string_view preset) {
  std::vector<HistorianSettings> variants{config::historian_preset(preset)};
  if (preset == "thingsboard") {
    variants.push_back(variants.front());
    variants.back().subtag_table = "public.key_dictionary";
  }
  return variants;
}

std::optional<LayoutCandidate> find_vendor(const HistorianSettings& preset,
                                           const std::vector<SeenTable>& tables) {
  if (auto usual = in_schema(preset, "", tables)) return usual;
  std::set<std::string> schemas;
  for (const SeenTable& table : tables) schemas.insert(table.schema);
  for (const std::string& schema : schemas) {
    if (auto elsewhere = in_schema(preset, schema, tables)) return elsewhere;
  }
  return std::nullopt;
}

/// The table of this name in any schema, the fewest columns of it that are missing.
std::string missing_of(const storage::TableName& usual, const std::set<std::string>& wanted,
                       const std::vector<SeenTable>& tables) {
  std::string best = fmt::format("no table {}", usual.table);
  std::size_t fewest = wanted.size() + 1;
  for (const SeenTable& table : tables) {
    if (table.name != usual.table) continue;
    std::vector<std::string> lacking;
    for (const std::string& name : wanted) {
      if (!has_columns(table, {name})) lacking.push_back(name);
    }
    if (lacking.size() >= fewest) continue;
    fewest = lacking.size();
    best = lacking.empty()
               ? ""
               : fmt::format("no {} {} in {}.{}", lacking.size() == 1 ? "column" : "columns",
                             fmt::join(lacking, ", "), table.schema, table.name);
  }
  return best;
}

}  // namespace

bool is_vendor(std::string_view preset) {
  return preset != "narrow" && preset != "loop_row" && preset != "wide" && preset != "telegraf";
}

std::vector<LayoutCandidate> vendor_layouts(const std::vector<SeenTable>& tables) {
  std::vector<LayoutCandidate> found;
  for (const std::string_view preset : config::preset_names()) {
    if (!is_vendor(preset)) continue;
    for (const HistorianSettings& variant : variants_of(preset)) {
      auto candidate = find_vendor(variant, tables);
      if (!candidate) continue;
      candidate->seen = fmt::format("the tables of {}: {}", preset, candidate->seen);
      found.push_back(*std::move(candidate));
      break;
    }
  }
  return found;
}

std::string missing_of_vendor(const std::vector<SeenTable>& tables, const std::string& preset) {
  const HistorianSettings historian = config::historian_preset(preset);
  if (find_vendor(historian, tables)) return {};
  std::string missing;
  for (const TableSetting& setting : kTableSettings) {
    if (!is_needed(historian, setting)) continue;
    const std::string lacks =
        missing_of(split(historian.*setting.table), columns_of(historian, setting), tables);
    if (!lacks.empty()) missing += (missing.empty() ? "" : ", ") + lacks;
  }
  return missing.empty() ? "its tables lie in several schemas" : missing;
}

std::vector<storage::TableName> usual_tables(const std::string& preset) {
  if (preset.empty() || !is_vendor(preset)) return {};
  const HistorianSettings historian = config::historian_preset(preset);
  std::vector<storage::TableName> tables;
  for (const TableSetting& setting : kTableSettings) {
    if (is_needed(historian, setting)) tables.push_back(split(historian.*setting.table));
  }
  return tables;
}

}  // namespace loopscope::daemon
