#pragma once

#include <filesystem>
#include <string>

namespace loopscope::tests {

/// The first line of a file that somebody is about to write; empty = not within `seconds`.
[[nodiscard]] std::string first_line_of(const std::filesystem::path& file, double seconds);

/// Whether the process of that number is gone, or waits to be buried, within `seconds`.
[[nodiscard]] bool ends_within(const std::string& pid, double seconds);

}  // namespace loopscope::tests
