#include "daemon/text/cell_failure.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "daemon/text/cells.hpp"
#include "daemon/text/printable.hpp"

namespace loopscope::daemon {
namespace {

/// One line of a terminal still holds the file, the place and this much of the cell.
constexpr std::size_t kMostCharacters = 60;

}  // namespace

std::string shown(std::string_view cell) {
  std::string text = "\"";
  for (std::size_t count = 0; !cell.empty() && count < kMostCharacters; ++count) {
    const std::size_t length = printable_length(cell);
    text += length > 0 ? std::string(cell.substr(0, length)) : escaped_byte(cell.front());
    cell.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return text + (cell.empty() ? "\"" : "...\"");
}

Failure cell_failure(const CsvTable& table, const CsvTable::Row& row, std::size_t column,
                     const std::string& problem, const std::string& hint) {
  return {ExitCode::unusable_data,
          fmt::format("{}, line {}, column \"{}\": {}", table.name, row.line,
                      trimmed(table.header[column]), problem),
          hint};
}

}  // namespace loopscope::daemon
