#include "daemon/report/page/page_frame.hpp"

#include <fmt/format.h>

#include "daemon/report/page/page_assets.hpp"
#include "daemon/report/page/template.hpp"
#include "daemon/report/text/base64.hpp"

namespace loopscope::daemon {

const std::string& content_security_policy() {
  static const std::string policy = fmt::format(
      "default-src 'none'; img-src data:; style-src {}; script-src {} {}; base-uri 'none'; "
      "form-action 'self'",
      csp_hash(page_style().sha256), csp_hash(page_script().sha256),
      csp_hash(trend_script().sha256));
  return policy;
}

std::string page(const PageFrame& frame, const std::vector<Markup>& sections) {
  // Policy, style and scripts are the program's own; the digests are of the bytes as they are.
  const Markup whole = render("page", {{"policy", Markup(content_security_policy())},
                                       {"referrer", frame.referrer},
                                       {"title", frame.title},
                                       {"style", Markup(page_style().text)},
                                       {"subtitle", frame.subtitle},
                                       {"navigation", frame.navigation},
                                       {"zone", frame.zone},
                                       {"local", frame.zone != "UTC"},
                                       {"sections", sections},
                                       {"version", LOOPSCOPE_VERSION},
                                       {"script", Markup(page_script().text)},
                                       {"trend", Markup(frame.trend ? trend_script().text : "")}});
  return whole.html + "\n";
}

}  // namespace loopscope::daemon
