#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace loopscope::daemon {

/// How much a client wants an answer in each form, 0 (never) to 1 (RFC 9110, 12.5.3).
struct AcceptedCodings {
  double identity = 1.0;
  double gzip = 0.0;

  [[nodiscard]] bool prefers_gzip() const { return gzip > 0.0 && gzip >= identity; }
};

/// What the header Accept-Encoding asks for; nullopt = there was none, and the answer goes as it
/// is. Codings that nobody knows here, and elements that are none, are passed over.
[[nodiscard]] AcceptedCodings accepted_codings(const std::optional<std::string>& header);

/// The text as a gzip file. Milliseconds for a megabyte. Throws std::bad_alloc.
[[nodiscard]] std::string gzip(std::string_view text);

}  // namespace loopscope::daemon
