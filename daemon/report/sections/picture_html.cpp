#include "daemon/report/sections/picture_html.hpp"

#include <fmt/format.h>

#include "daemon/report/figures/compact_svg.hpp"
#include "daemon/report/text/html_text.hpp"

namespace loopscope::daemon {

std::string picture_html(const Picture& picture) {
  return fmt::format(
      "<figure><figcaption>{}</figcaption><img src=\"{}\" width=\"{}\" height=\"{}\" "
      "alt=\"{}\"></figure>\n",
      html(picture.title), svg_uri(picture.svg), picture.width, picture.height, html(picture.alt));
}

}  // namespace loopscope::daemon
