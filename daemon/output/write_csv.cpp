#include "daemon/output/write_csv.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <iostream>
#include <string_view>

#include "core/text/counted.hpp"
#include "daemon/output/output_file.hpp"
#include "daemon/output/standard_output.hpp"
#include "daemon/text/cells.hpp"
#include "daemon/text/csv_table.hpp"

namespace loopscope::daemon {

bool is_formula(std::string_view cell) {
  constexpr std::string_view kStarts = "=+-@\t\r";
  return !cell.empty() && kStarts.find(cell.front()) != std::string_view::npos &&
         !parse_number(cell);
}

std::size_t count_formulas(const std::string& csv) {
  std::size_t count = 0;
  for (const CsvTable::Row& row : parse_csv(csv, "").rows) {
    count += static_cast<std::size_t>(std::ranges::count_if(row.cells, is_formula));
  }
  return count;
}

void note_formulas(std::size_t count) {
  if (count == 0) return;
  std::cerr << fmt::format(
      "note: {} with =, +, - or @: a spreadsheet takes this for a formula unless it is told to "
      "import every column as text\n",
      core::text::counted(count, "cell begins", "cells begin"));
}

void write_csv(const std::string& file, const std::string& csv) {
  if (file == "-") {
    write_to_standard_output(csv);
  } else {
    write_file(file, csv);
  }
  note_formulas(count_formulas(csv));
}

}  // namespace loopscope::daemon
