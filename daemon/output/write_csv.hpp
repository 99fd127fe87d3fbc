#pragma once

#include <cstddef>
#include <string>

namespace loopscope::daemon {

/// Writes a CSV that holds names to `file`, or to standard output for "-". Names go out byte for
/// byte, because the file is read in again; what a spreadsheet would take for formulas is counted
/// and said on standard error. Throws Failure as write_file() does.
void write_csv(const std::string& file, const std::string& csv);

/// Cells that begin with =, +, -, @, a tab or a carriage return and are no numbers.
[[nodiscard]] std::size_t count_formulas(const std::string& csv);

}  // namespace loopscope::daemon
