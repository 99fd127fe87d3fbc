#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace loopscope::storage {

/// Bytes of the valid character of UTF-8 that `text` (not empty) starts with; 0 = none, or a zero
/// byte.
[[nodiscard]] std::size_t character_length(std::string_view text);

/// Whether PostgreSQL takes `text` as it is: valid UTF-8 without a zero byte.
[[nodiscard]] bool is_storable(std::string_view text);

/// `text` with every byte that PostgreSQL would refuse replaced by U+FFFD. For messages and
/// findings: one odd byte in an error text must not cost a whole batch of results.
[[nodiscard]] std::string make_storable(std::string_view text);

}  // namespace loopscope::storage
