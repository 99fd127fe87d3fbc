#include "daemon/report/page/page_frame.hpp"

#include <fmt/format.h>

#include "daemon/report/page/page_assets.hpp"
#include "daemon/report/text/base64.hpp"
#include "daemon/report/text/html_text.hpp"

namespace loopscope::daemon {

const std::string& content_security_policy() {
  static const std::string policy = fmt::format(
      "default-src 'none'; img-src data:; style-src {}; script-src {}; base-uri 'none'; "
      "form-action 'none'",
      csp_hash(page_style().sha256), csp_hash(page_script().sha256));
  return policy;
}

std::string page(const PageFrame& frame, const std::string& content) {
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"{}\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"referrer\" content=\"no-referrer\">\n"
      "<link rel=\"icon\" href=\"data:,\">\n<title>{}</title>\n",
      content_security_policy(), html(frame.title));
  text += std::string("<style>") + page_style().text + "</style>\n</head>\n<body>\n";
  text += fmt::format("<header class=\"top\"><h1><bdi>{}</bdi></h1><p>{}</p>{}</header>\n<main>\n",
                      html(frame.title), html(frame.subtitle), frame.navigation);
  text += content;
  text += "</main>\n<footer><p>Loopscope " LOOPSCOPE_VERSION
          ". All times are UTC. Colours: Okabe and Ito; viridis.</p></footer>\n";
  return text + "<script>" + page_script().text + "</script>\n</body>\n</html>\n";
}

}  // namespace loopscope::daemon
