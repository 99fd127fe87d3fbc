#include "daemon/catalogue/catalogue_csv.hpp"

#include <fmt/format.h>
#include <set>
#include <stdexcept>

#include "daemon/catalogue/entry_fields.hpp"
#include "daemon/failure.hpp"
#include "daemon/recording/cells.hpp"

namespace loopscope::daemon {
namespace {

using storage::CatalogueEntry;

std::vector<const EntryField*> fields_of(const CsvTable& table) {
  std::vector<const EntryField*> fields;
  for (const std::string& column : table.header) {
    fields.push_back(find_entry_field(column));
    if (fields.back() != nullptr) continue;
    throw Failure(ExitCode::unusable_data,
                  fmt::format("{}, line 1: unknown column \"{}\"", table.name, column),
                  "`loopscope loops export -` shows the columns");
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
                  "nothing was changed: mend the line and load the file again");
  }
}

CatalogueEntry entry_of(const CsvTable& table, const CsvTable::Row& row,
                        const std::vector<const EntryField*>& fields, CatalogueEntry entry) {
  for (std::size_t k = 0; k < fields.size(); ++k) {
    if (trimmed(row.cells[k]).empty()) continue;
    with_place(table, row.line, fmt::format(", column {}", fields[k]->name),
               [&] { fields[k]->write(entry, row.cells[k]); });
  }
  with_place(table, row.line, "", [&] { check_entry(entry); });
  return entry;
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

std::vector<CatalogueEntry> parse_catalogue(const CsvTable& table, const CatalogueEntry& defaults) {
  const std::vector<const EntryField*> fields = fields_of(table);
  std::vector<CatalogueEntry> entries;
  std::set<std::string> names;
  for (const CsvTable::Row& row : table.rows) {
    entries.push_back(entry_of(table, row, fields, defaults));
    with_place(table, row.line, "", [&] {
      if (names.insert(entries.back().name).second) return;
      throw std::invalid_argument(fmt::format("\"{}\" stands twice", entries.back().name));
    });
  }
  return entries;
}

}  // namespace loopscope::daemon
