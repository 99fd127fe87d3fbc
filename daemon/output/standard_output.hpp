#pragma once

#include <string>
#include <string_view>

namespace loopscope::daemon {

/// Writes to standard output, a file's or a program's byte for byte. A terminal gets each line as
/// printable() shows it, so that no name steers it. Throws Failure (usage) when it cannot be
/// written: nobody reads on, or the disk is full.
void write_to_standard_output(std::string_view text);

/// What a terminal gets: line breaks stay.
[[nodiscard]] std::string lines_for_terminal(std::string_view text);

}  // namespace loopscope::daemon
