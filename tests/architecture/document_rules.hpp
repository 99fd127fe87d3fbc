#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "tests/architecture/checkout.hpp"

namespace loopscope::tests::architecture {

/// Links of documents, and paths between backquotes that begin with a room or tests/, that lead
/// nowhere below `root`. A path may leave out the ending of a file ("core/hos/analyse"); with a
/// word in capitals it is a pattern ("tests/core/NAME_test.cpp").
[[nodiscard]] std::vector<Violation> check_paths(std::span<const SourceFile> documents,
                                                 const std::filesystem::path& root);

}  // namespace loopscope::tests::architecture
