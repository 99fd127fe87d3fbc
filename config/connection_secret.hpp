#pragma once

#include <string_view>

namespace loopscope::config {

/// Whether a libpq connection string, in the keyword form or as a URI, carries a password or the
/// passphrase of a key. A malformed string is judged as far as it can be read; whether it is valid
/// is libpq's to say when it connects.
[[nodiscard]] bool holds_secret(std::string_view connection);

/// Whether a URI has a text where a port should be, as in "postgresql://user:secret/db", where the
/// host was forgotten: libpq would take the password for the port, and show it.
[[nodiscard]] bool has_text_for_port(std::string_view connection);

}  // namespace loopscope::config
