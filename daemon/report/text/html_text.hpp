#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace loopscope::daemon {

/// `text` as HTML shows it, safe between tags and inside an attribute in double quotes: & < > " '
/// become references, and what steers a terminal or the direction of writing becomes \xNN
/// (text/printable). Every text that a template of page/templates names goes through here; a
/// browser and a PDF engine then see names as text, whatever somebody typed into a control system.
[[nodiscard]] std::string html(std::string_view text);

/// `text` as the value of a query: everything but letters, digits and - . _ ~ as %XX (RFC 3986).
[[nodiscard]] std::string url_value(std::string_view text);

}  // namespace loopscope::daemon
