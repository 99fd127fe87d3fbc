#include "daemon/catalogue/catalogue_csv.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>
#include <stdexcept>

#include "config/nearest_name.hpp"
#include "daemon/catalogue/entry_fields.hpp"
#include "daemon/text/cells.hpp"
#include "daemon/text/failure.hpp"

namespace loopscope::daemon {
namespace {

using storage::CatalogueEntry;

/// What an unknown column may have meant.
std::string column_hint(std::string_view column) {
  constexpr const char* kAll = "`loopscope loops export -` shows the columns";
  for (const TagRole& role : kTagRoles)
    if (same_word(role.name, column))
      return fmt::format("did you mean \"{}_tag\"? {}", role.name, kAll);
  std::vector<std::string> known;
  for (const EntryField& field : entry_fields()) known.emplace_back(field.name);
  const auto nearest = config::nearest_name(column, known);
  return nearest ? fmt::format("did you mean \"{}\"? {}", *nearest, kAll) : kAll;
}

std::vector<const EntryField*> fields_of(const CsvTable& table) {
  std::vector<const EntryField*> fields;
  for (const std::string& column : table.header) {
    const EntryField* field = find_entry_field(column);
    if (field != nullptr && std::find(fields.begin(), fields.end(), field) != fields.end()) {
      throw Failure(ExitCode::unusable_data,
                    fmt::format("{}, line 1: column \"{}\" stands twice", table.name, column),
                    "leave one of them out");
    }
    fields.push_back(field);
    if (field != nullptr) continue;
    throw Failure(ExitCode::unusable_data,
                  fmt::format("{}, line 1: unknown column \"{}\" (cells separated by {})",
                              table.name, column, separators_text(table.separator)),
                  column_hint(trimmed(column)));
  }
  return fields;
}

template <typename Action>
void with_place(const CsvTable& table, std::size_t line, std::string_view column, Action action) {
  try {
    action();
  } catch (const std::invalid_argument& problem) {
    throw Failure(ExitCode::unusable_data,
                  fmt::format("{}, line {}{}: {}", table.name, line, column, problem.what()),
                  "nothing was changed: correct the line and load the file again");
  }
}

CatalogueEntry entry_of(const CsvTable& table, const CsvTable::Row& row,
                        const std::vector<const EntryField*>& fields, CatalogueEntry entry) {
  for (std::size_t k = 0; k < fields.size(); ++k) {
    if (trimmed(row.cells[k]).empty() && !can_be_empty(*fields[k])) continue;
    with_place(table, row.line, fmt::format(", column {}", fields[k]->name),
               [&] { fields[k]->write(entry, row.cells[k]); });
  }
  with_place(table, row.line, "", [&] { check_entry(entry); });
  return entry;
}

/// The entry that a row starts from: the stored loop of its name, else the defaults.
CatalogueEntry start_of(const CsvTable::Row& row, const std::vector<const EntryField*>& fields,
                        const CatalogueEntry& defaults,
                        const std::map<std::string, CatalogueEntry>& stored) {
  for (std::size_t k = 0; k < fields.size(); ++k) {
    if (fields[k]->name != "name") continue;
    const auto known = stored.find(row.cells[k]);
    return known == stored.end() ? defaults : known->second;
  }
  return defaults;
}

}  // namespace

std::string catalogue_csv(std::span<const CatalogueEntry> entries) {
  std::string text;
  const auto append = [&text](std::string_view cell, bool first) {
    if (!first) text += ',';
    text += csv_cell(cell);
  };
  for (const EntryField& field : entry_fields()) append(field.name, text.empty());
  text += '\n';
  for (const CatalogueEntry& entry : entries) {
    bool first = true;
    for (const EntryField& field : entry_fields()) {
      append(field.read(entry), first);
      first = false;
    }
    text += '\n';
  }
  return text;
}

bool is_header_of_catalogue(const std::vector<std::string>& header) {
  return std::ranges::any_of(
      header, [](const std::string& column) { return find_entry_field(column) != nullptr; });
}

std::vector<CatalogueEntry> parse_catalogue(const CsvTable& table, const CatalogueEntry& defaults,
                                            std::span<const CatalogueEntry> stored) {
  std::map<std::string, CatalogueEntry> by_name;
  for (const CatalogueEntry& entry : stored) by_name[entry.name] = entry;
  const std::vector<const EntryField*> fields = fields_of(table);
  std::vector<CatalogueEntry> entries;
  std::set<std::string> names;
  for (const CsvTable::Row& row : table.rows) {
    entries.push_back(entry_of(table, row, fields, start_of(row, fields, defaults, by_name)));
    with_place(table, row.line, "", [&] {
      if (names.insert(entries.back().name).second) return;
      throw std::invalid_argument(fmt::format("\"{}\" stands twice", entries.back().name));
    });
  }
  return entries;
}

}  // namespace loopscope::daemon
