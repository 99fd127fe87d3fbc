#include "daemon/monitor/http_answer.hpp"

#include <boost/beast/http/status.hpp>
#include <fmt/format.h>
#include <utility>

#include "daemon/monitor/content_coding.hpp"

namespace loopscope::daemon {
namespace {

constexpr int kDone = 200;

using Body = std::shared_ptr<const std::string>;

std::string head_of(const HttpAnswer& answer, std::size_t body_bytes, bool gzipped) {
  const auto reason = boost::beast::http::obsolete_reason(
      boost::beast::http::int_to_status(static_cast<unsigned>(answer.status)));
  std::string head = fmt::format(
      "HTTP/1.1 {} {}\r\nCache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\n"
      "Connection: close\r\nVary: Accept-Encoding\r\nContent-Type: {}\r\nContent-Length: {}\r\n",
      answer.status, std::string_view(reason.data(), reason.size()), answer.content_type,
      body_bytes);
  if (gzipped) head += "Content-Encoding: gzip\r\n";
  for (const auto& [name, value] : answer.headers) head += fmt::format("{}: {}\r\n", name, value);
  return head + "\r\n";
}

HttpMessage message_of(const HttpAnswer& answer, Body body, bool gzipped, bool head_only) {
  std::string head = head_of(answer, body->size(), gzipped);
  return {std::move(head), head_only ? std::make_shared<const std::string>() : std::move(body)};
}

}  // namespace

HttpMessage make_message(std::shared_ptr<const HttpAnswer> answer, const HttpRequest& request) {
  const bool head_only = request.method == "HEAD";
  const AcceptedCodings wanted = accepted_codings(request.accept_encoding);
  if (wanted.prefers_gzip() && !answer->gzipped.empty())
    return message_of(*answer, Body(answer, &answer->gzipped), true, head_only);
  // A refusal is small, and says more than that its form is not wanted.
  if (wanted.identity > 0.0 || answer->status != kDone)
    return message_of(*answer, Body(answer, &answer->body), false, head_only);
  // What has no second form is small: a few kilobytes.
  if (wanted.gzip > 0.0) {
    return message_of(*answer, std::make_shared<const std::string>(gzip(answer->body)), true,
                      head_only);
  }
  const HttpAnswer refusal{406,
                           "there is this answer as it is and as gzip: Accept-Encoding "
                           "wants neither\n"};
  return message_of(refusal, std::make_shared<const std::string>(refusal.body), false, head_only);
}

void add_gzipped(HttpAnswer& answer) {
  constexpr std::size_t kWorthIt = 1024;  // bytes; fewer fit into one packet anyway
  if (answer.body.size() >= kWorthIt) answer.gzipped = gzip(answer.body);
}

}  // namespace loopscope::daemon
