#include "daemon/monitor/http_routes.hpp"

#include <exception>
#include <spdlog/spdlog.h>
#include <utility>

#include "daemon/monitor/plain_line.hpp"

namespace loopscope::daemon {
namespace {

HttpAnswer reading_only() {
  HttpAnswer refusal{405, "only GET and HEAD\n"};
  refusal.headers.emplace("Allow", "GET, HEAD");
  return refusal;
}

}  // namespace

void HttpRoutes::add(const std::string& path, HttpHandler handler) {
  add_deferred(path,
               [handler = std::move(handler)](const HttpRequest& request, const HttpReply& reply) {
                 reply.send(handler(request));
               });
}

void HttpRoutes::add_deferred(const std::string& path, DeferredHandler handler) {
  handlers_[path] = std::move(handler);
}

void HttpRoutes::answer(const HttpRequest& request, const HttpReply& reply) const {
  if (request.method != "GET" && request.method != "HEAD") return reply.send(reading_only());
  const auto found = handlers_.find(request.path);
  if (found == handlers_.end()) return reply.send(HttpAnswer{404, "there is nothing here\n"});
  try {
    found->second(request, reply);
  } catch (const std::exception& error) {
    constexpr std::size_t kMostPathBytes = 200;
    spdlog::error("HTTP: {}: {}", plain_line(request.path, kMostPathBytes), error.what());
    reply.send(HttpAnswer{500, "this failed: the log says why\n"});
  }
}

}  // namespace loopscope::daemon
