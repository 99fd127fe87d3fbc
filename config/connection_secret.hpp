#pragma once

#include <string_view>

namespace loopscope::config {

/// Whether a libpq connection string, in the keyword form or as a URI, carries a password or the
/// passphrase of a key. A malformed string is judged as far as it can be read; whether it is valid
/// is libpq's to say when it connects.
[[nodiscard]] bool holds_secret(std::string_view connection);

}  // namespace loopscope::config
