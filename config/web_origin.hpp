#pragma once

#include <string_view>

namespace loopscope::config {

/// Whether the text is an origin as browsers send it (RFC 6454, 6.2): "https://host" or
/// "http://host:8080", in small letters, with no path, no slash at the end and no port that the
/// scheme has anyway. Such texts are compared whole.
[[nodiscard]] bool is_web_origin(std::string_view text);

}  // namespace loopscope::config
