#pragma once

#include <string>
#include <string_view>

namespace loopscope::storage {

/// Whether PostgreSQL takes `text` as it is: valid UTF-8 without a zero byte.
[[nodiscard]] bool is_storable(std::string_view text);

/// `text` with every byte that PostgreSQL would refuse replaced by U+FFFD. For messages and
/// findings: one odd byte in an error text must not cost a whole batch of results.
[[nodiscard]] std::string make_storable(std::string_view text);

}  // namespace loopscope::storage
