#pragma once

#include <vector>

#include "tests/architecture/checkout.hpp"

namespace loopscope::tests::architecture {

/// Every #include line of a room's C++ file that breaks a rule, and every use of a source of
/// randomness or of the environment in a pure room. Files outside the rooms may do anything.
[[nodiscard]] std::vector<Violation> check_includes(const SourceFile& file);

}  // namespace loopscope::tests::architecture
