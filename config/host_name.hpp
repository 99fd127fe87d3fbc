#pragma once

#include <string_view>

namespace loopscope::config {

/// Whether the text can be the name of a host, "loopscope.plant.example": labels of letters,
/// digits,
/// - and _ between dots. A scheme, a port, a pattern or a path is none; a name with other letters
/// is written as the name servers know it ("xn--...").
[[nodiscard]] bool is_host_name(std::string_view text);

}  // namespace loopscope::config
