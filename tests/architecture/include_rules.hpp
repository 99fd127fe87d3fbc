#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/architecture/checkout.hpp"

namespace loopscope::tests::architecture {

/// What an #include line names.
struct Include {
  bool quoted = false;
  std::string header;
};

/// nullopt for any other line.
[[nodiscard]] std::optional<Include> include_of(const std::string& line);

/// Every #include line of a room's C++ file that breaks a rule, and every use of a source of
/// randomness or of the environment in a pure room. Files outside the rooms may do anything.
[[nodiscard]] std::vector<Violation> check_includes(const SourceFile& file);

}  // namespace loopscope::tests::architecture
