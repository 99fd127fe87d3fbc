#include "daemon/report/page/page_answer.hpp"

#include <utility>

#include "daemon/report/page/page_frame.hpp"

namespace loopscope::daemon {

HttpAnswer page_answer(int status, std::string html, const std::string& referrer) {
  HttpAnswer answer{status, std::move(html), "text/html; charset=utf-8"};
  answer.headers.emplace("Content-Security-Policy",
                         content_security_policy() + "; frame-ancestors 'none'");
  answer.headers.emplace("Referrer-Policy", referrer);
  return answer;
}

}  // namespace loopscope::daemon
