#pragma once

#include <span>
#include <vector>

#include "tests/architecture/checkout.hpp"

namespace loopscope::tests::architecture {

/// Folders of the rooms that include each other, directly or around: each as a violation of the
/// first of them that names the whole circle. Of two folders one is the lower floor.
[[nodiscard]] std::vector<Violation> check_folder_circles(std::span<const SourceFile> files);

/// Folders of the rooms with more files than a reader takes in: 60, and 30 in rooms that have
/// folders so that each holds one subject.
[[nodiscard]] std::vector<Violation> check_folder_sizes(std::span<const SourceFile> files);

/// Folders within a room that the room's README does not name with its purpose, as in
/// "| `kernels/` | vector loops ... |".
[[nodiscard]] std::vector<Violation> check_folder_purposes(std::span<const SourceFile> files,
                                                           std::span<const SourceFile> documents);

}  // namespace loopscope::tests::architecture
