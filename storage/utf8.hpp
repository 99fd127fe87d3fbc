#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace loopscope::storage {

/// A character of UTF-8.
struct Character {
  std::size_t length = 0;  ///< bytes; 0 = none
  char32_t code = 0;
};

/// The valid character that `text` starts with; none where it is empty or starts with a zero byte.
[[nodiscard]] Character first_character(std::string_view text);

/// Characters of `text`, which is_storable().
[[nodiscard]] std::size_t count_characters(std::string_view text);

/// Whether PostgreSQL takes `text` as it is: valid UTF-8 without a zero byte.
[[nodiscard]] bool is_storable(std::string_view text);

/// `text` with every byte that PostgreSQL would refuse replaced by U+FFFD. For messages and
/// findings: one odd byte in an error text must not cost a whole batch of results.
[[nodiscard]] std::string make_storable(std::string_view text);

}  // namespace loopscope::storage
