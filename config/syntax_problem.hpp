#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "config/problem.hpp"

namespace loopscope::config {

/// Turns a parser's complaint into a problem for people. `characters_read` counts the bytes up to
/// and with the last one of the offending token; `token` is that token as the parser has kept it.
[[nodiscard]] Problem syntax_problem(std::string_view text, std::size_t characters_read,
                                     std::string_view token, std::string_view complaint);

}  // namespace loopscope::config
