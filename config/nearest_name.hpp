#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace loopscope::config {

/// Single-character insertions, deletions, replacements and swaps of neighbours that turn `a`
/// into `b` (optimal string alignment distance); case counts for nothing.
[[nodiscard]] std::size_t spelling_distance(std::string_view a, std::string_view b);

/// The known name that `name` most likely stands for, by spelling_distance(); nullopt when none is
/// near enough to be a misspelling (one character, or a third of `name`'s), and for a `name` of
/// more than 64 bytes.
[[nodiscard]] std::optional<std::string> nearest_name(std::string_view name,
                                                      const std::vector<std::string>& known);

}  // namespace loopscope::config
