#include "daemon/monitor/http_routes.hpp"

#include <exception>
#include <spdlog/spdlog.h>
#include <utility>

#include "daemon/monitor/plain_line.hpp"

namespace loopscope::daemon {

void HttpRoutes::add(const std::string& path, HttpHandler handler) {
  exact_[path] = std::move(handler);
}

void HttpRoutes::add_below(const std::string& prefix, HttpHandler handler) {
  below_[prefix] = std::move(handler);
}

const HttpHandler* HttpRoutes::handler_of(const std::string& path) const {
  if (const auto found = exact_.find(path); found != exact_.end()) return &found->second;
  const HttpHandler* longest = nullptr;
  for (const auto& [prefix, handler] : below_) {  // of one path the shorter prefix comes first
    if (path.starts_with(prefix)) longest = &handler;
  }
  return longest;
}

HttpAnswer HttpRoutes::answer(const std::string& method, const HttpRequest& request) const {
  if (method != "GET" && method != "HEAD") {
    HttpAnswer refusal{405, "only GET and HEAD\n"};
    refusal.headers.emplace("Allow", "GET, HEAD");
    return refusal;
  }
  const HttpHandler* handler = handler_of(request.path);
  if (handler == nullptr) return {404, "there is nothing here\n"};
  try {
    return (*handler)(request);
  } catch (const std::exception& error) {
    constexpr std::size_t kMostPathBytes = 200;
    spdlog::error("HTTP: {}: {}", plain_line(request.path, kMostPathBytes), error.what());
    return {500, "this failed: the log says why\n"};
  }
}

}  // namespace loopscope::daemon
