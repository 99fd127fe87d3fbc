#include "daemon/recording/decimal_sign.hpp"

#include <algorithm>
#include <string_view>

#include "daemon/text/cell_failure.hpp"
#include "daemon/text/cells.hpp"

namespace loopscope::daemon {
namespace {

constexpr std::size_t kGroup = 3;

bool is_digits(std::string_view text) {
  return std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

/// "1,234", "12,345,678.5": one to three digits, not beginning with 0, then threes.
bool may_be_grouped(std::string_view cell) {
  cell = trimmed(cell);
  if (!cell.empty() && (cell.front() == '-' || cell.front() == '+')) cell.remove_prefix(1);
  const std::string_view whole = cell.substr(0, cell.find('.'));
  std::size_t at = whole.find(',');
  const std::string_view first = whole.substr(0, at);
  if (at == std::string_view::npos) return false;
  if (first.empty() || first.size() > kGroup || first.front() == '0' || !is_digits(first))
    return false;
  while (at != std::string_view::npos) {
    const std::size_t next = whole.find(',', at + 1);
    const std::string_view group = whole.substr(at + 1, next - at - 1);
    if (group.size() != kGroup || !is_digits(group)) return false;
    at = next;
  }
  return true;
}

}  // namespace

char find_decimal_sign(const CsvTable& table, const std::vector<std::size_t>& columns,
                       std::optional<char> said) {
  if (said) return *said;
  if (table.separator == ',') return '.';
  const CsvTable::Row* doubtful_row = nullptr;
  std::size_t doubtful_column = 0;
  for (const CsvTable::Row& row : table.rows) {
    for (const std::size_t column : columns) {
      if (row.cells[column].find(',') == std::string::npos) continue;
      if (!may_be_grouped(row.cells[column])) return ',';
      if (doubtful_row != nullptr) continue;
      doubtful_row = &row;
      doubtful_column = column;
    }
  }
  if (doubtful_row == nullptr) return '.';
  throw cell_failure(table, *doubtful_row, doubtful_column,
                     "the comma in " + shown(doubtful_row->cells[doubtful_column]) +
                         " may be a decimal sign or group thousands",
                     "--decimal-sign comma where it is the decimal sign; else write the numbers "
                     "without groups");
}

}  // namespace loopscope::daemon
