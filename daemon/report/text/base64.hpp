#pragma once

#include <string>
#include <string_view>

namespace loopscope::daemon {

/// RFC 4648, section 4, with padding.
[[nodiscard]] std::string base64(std::string_view bytes);

/// A digest in hexadecimal digits as a source of a Content-Security-Policy: 'sha256-...'.
[[nodiscard]] std::string csp_hash(std::string_view sha256_hex);

}  // namespace loopscope::daemon
