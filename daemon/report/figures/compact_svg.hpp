#pragma once

#include <string>
#include <string_view>

#include "daemon/report/page/fields.hpp"

namespace loopscope::daemon {

/// A picture of gnuplot's svg terminal as a page takes it in: the root element alone, without marks
/// that are not drawn and groups that are empty, paths to a tenth of a pixel and without blanks,
/// type that every system has, and no `currentColor`, at which WeasyPrint 57 fails. A third
/// shorter.
[[nodiscard]] std::string compact_svg(std::string_view document);

/// An SVG as the value of an attribute in double quotes: a data URI with as few escapes as there
/// can be, which is a quarter shorter than base64.
[[nodiscard]] Markup svg_uri(std::string_view svg);

}  // namespace loopscope::daemon
