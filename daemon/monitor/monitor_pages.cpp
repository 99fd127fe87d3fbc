#include "daemon/monitor/monitor_pages.hpp"

#include <utility>

namespace loopscope::daemon {
namespace {

HttpAnswer http_answer(const HealthAnswer& answer) {
  return {answer.http_status(), answer.text};
}

}  // namespace

void add_monitor_pages(HttpServer& server, const Health& health, Metrics& metrics,
                       std::function<double()> seconds_since_progress) {
  server.handle("/livez", [&health](const HttpRequest&) { return http_answer(health.live()); });
  server.handle("/readyz", [&health](const HttpRequest&) { return http_answer(health.ready()); });
  server.handle("/metrics",
                [&metrics, since = std::move(seconds_since_progress)](const HttpRequest&) {
                  metrics.since_progress(since());
                  return HttpAnswer{200, metrics.text(), Metrics::kContentType};
                });
}

}  // namespace loopscope::daemon
