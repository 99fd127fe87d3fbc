#include "daemon/monitor/monitor_pages.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/daemon/monitor/exposition.hpp"
#include "tests/daemon/monitor/http_client.hpp"

namespace loopscope::daemon {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Pair;
using testing::StartsWith;

TEST(MonitorPages, TellLifeReadinessAndFigures) {
  std::optional<std::string> standing_still;
  Health health([&] { return standing_still; }, HealthLimits{});
  Metrics metrics({"0.1.0", 8, "avx2"});
  HttpServer server({"127.0.0.1", 0, true});
  add_monitor_pages(server, health, metrics, [] { return 2.5; });
  server.start();

  EXPECT_EQ(body_of(http_get(server.port(), "/livez")), "ok\n");
  EXPECT_THAT(http_get(server.port(), "/readyz"), StartsWith("HTTP/1.1 503 "));
  health.results_answered();
  EXPECT_THAT(http_get(server.port(), "/readyz"), StartsWith("HTTP/1.1 200 "));
  standing_still = "the heartbeat has not advanced for 90 s";
  const std::string livez = http_get(server.port(), "/livez");
  EXPECT_THAT(livez, StartsWith("HTTP/1.1 503 "));
  EXPECT_EQ(body_of(livez), "the heartbeat has not advanced for 90 s\n");

  const std::string page = http_get(server.port(), "/metrics");
  EXPECT_THAT(page, HasSubstr("Content-Type: text/plain; version=0.0.4; charset=utf-8\r\n"));
  EXPECT_THAT(read_exposition(body_of(page)).samples,
              Contains(Pair("loopscope_seconds_since_progress", 2.5)));
}

}  // namespace
}  // namespace loopscope::daemon
