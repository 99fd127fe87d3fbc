#pragma once

#include <span>
#include <string>
#include <vector>

#include "tests/architecture/checkout.hpp"

namespace loopscope::tests::architecture {

/// Folders that have no place at the top level.
[[nodiscard]] std::vector<Violation> check_top_level(std::span<const std::string> folders);

/// Source files of the rooms without a header of the same name beside them.
[[nodiscard]] std::vector<Violation> check_headers(std::span<const SourceFile> files);

/// C++ files of core/ that stand in none of its rooms.
[[nodiscard]] std::vector<Violation> check_rooms(std::span<const SourceFile> files);

/// Files of more than 300 lines, READMEs of more than 150 (what a person reads before the code),
/// migrations of more than 900 lines or of a line of more than 120 characters.
[[nodiscard]] std::vector<Violation> check_lengths(std::span<const SourceFile> files);

}  // namespace loopscope::tests::architecture
