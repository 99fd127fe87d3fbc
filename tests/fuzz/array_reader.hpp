#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace loopscope::tests::fuzz {

/// The elements of a one-dimensional array literal as the PostgreSQL manual defines it (8.15.6,
/// array input and output syntax); nullopt = NULL. Ends the process for text that is none.
[[nodiscard]] std::vector<std::optional<std::string>> read_array(std::string_view text);

}  // namespace loopscope::tests::fuzz
