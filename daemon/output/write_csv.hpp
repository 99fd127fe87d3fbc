#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace loopscope::daemon {

/// Writes a CSV that holds names to `file`, or to standard output for "-". Names go out byte for
/// byte, because the file is read in again; what a spreadsheet would take for formulas is counted
/// and said on standard error. Throws Failure as write_file() and write_to_standard_output() do.
void write_csv(const std::string& file, const std::string& csv);

/// Whether a spreadsheet may take the cell for a formula: it begins with =, +, -, @, a tab or a
/// carriage return and is no number.
[[nodiscard]] bool is_formula(std::string_view cell);

/// Cells of that kind below the header. Throws as parse_csv().
[[nodiscard]] std::size_t count_formulas(const std::string& csv);

/// Says on standard error how many there are; nothing where there are none.
void note_formulas(std::size_t count);

}  // namespace loopscope::daemon
