#pragma once

#include <concepts>
#include <string>
#include <string_view>

namespace loopscope::core::text {

/// "1 loop", "3 loops".
template <std::integral Number>
[[nodiscard]] std::string counted(Number number, std::string_view singular,
                                  std::string_view plural) {
  return std::to_string(number).append(" ").append(number == 1 ? singular : plural);
}

}  // namespace loopscope::core::text
