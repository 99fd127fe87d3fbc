#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "tests/tables/table.hpp"

namespace {

using loopscope::tables::all_tables;
using loopscope::tables::Table;

constexpr int kFailed = 1;
constexpr int kUsage = 2;

constexpr std::string_view kHelp =
    "usage: tables NAME...\n"
    "       tables --list\n"
    "\n"
    "Prints tables of the READMEs. LOOPSCOPE_RECORDS=N replaces the number of records where a\n"
    "table says so.\n";

void print(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
}

void list() {
  for (const Table& table : all_tables())
    print(std::string(table.name) + ": " + std::string(table.about) + "\n");
}

int refuse(const std::string& what, const std::string& hint, int code) {
  std::fprintf(stderr, "error: %s\nHINT: %s\n", what.c_str(), hint.c_str());
  return code;
}

Table table_of(std::string_view name) {
  const auto tables = all_tables();
  const auto found = std::ranges::find(tables, name, &Table::name);
  if (found == tables.end()) throw std::invalid_argument("no table " + std::string(name));
  return *found;
}

/// All names first: an unknown one costs no minutes.
void print_tables(std::span<char* const> names) {
  for (const char* name : names) (void)table_of(name);
  for (const char* name : names) table_of(name).print();
}

}  // namespace

int main(int count, char** arguments) {
  const std::span<char* const> names(arguments + 1, arguments + count);
  const std::string_view first = names.empty() ? "" : names.front();
  if (first == "--list") return list(), EXIT_SUCCESS;
  if (first == "--help" || first == "-h") return print(kHelp), EXIT_SUCCESS;
  if (names.empty()) return refuse("which table?", "tables --list shows the names", kUsage);
  // NOLINTNEXTLINE(concurrency-mt-unsafe): there are no threads yet.
  setenv("LOOPSCOPE_LONG", "1", 1);  // a table has the records of the long form
  try {
    print_tables(names);
    return EXIT_SUCCESS;
  } catch (const std::invalid_argument& error) {
    return refuse(error.what(), "tables --list shows the names, tables --help the settings",
                  kUsage);
  } catch (const std::exception& error) {
    return refuse(error.what(), "compare with the README that has the table", kFailed);
  }
}
