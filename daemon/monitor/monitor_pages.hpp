#pragma once

#include <functional>

#include "daemon/monitor/health.hpp"
#include "daemon/monitor/http_server.hpp"
#include "daemon/monitor/metrics.hpp"

namespace loopscope::daemon {

/// Adds /livez, /readyz and /metrics to a server that has not started yet; the other two have to
/// outlive it. `seconds_since_progress` is asked at every look at the metrics, on the thread of the
/// server.
void add_monitor_pages(HttpServer& server, const Health& health, Metrics& metrics,
                       std::function<double()> seconds_since_progress);

}  // namespace loopscope::daemon
