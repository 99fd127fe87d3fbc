#include <future>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>
#include <thread>

#include "daemon/monitor/http_server.hpp"
#include "daemon/text/failure.hpp"
#include "tests/daemon/monitor/http_client.hpp"

/// Beginning and end of a server, and where it listens.
namespace loopscope::daemon {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// The port of a server that ends right after its start.
int port_of_a_short_life() {
  HttpServer server(kAnyPort);
  server.start();
  return server.port();
}

TEST(HttpServer, StopsRightAfterItsStartAndWithoutOne) {
  const auto start = Clock::now();
  for (int round = 0; round < 15; ++round) {
    const int port = port_of_a_short_life();
    EXPECT_GT(port, 0);
    EXPECT_THROW(HttpClient{port}, std::runtime_error) << "somebody listens still";
  }
  for (int round = 0; round < 5; ++round) {
    const HttpServer never_started(kAnyPort);
    EXPECT_EQ(never_started.port(), 0);
  }
  EXPECT_LT(Clock::now() - start, 4s);
}

TEST(HttpServer, SecondOneOnThePortIsRefusedWithAHint) {
  HttpServer first(kAnyPort);
  first.start();
  HttpServer second({"127.0.0.1", first.port(), true});
  try {
    second.start();
    FAIL() << "two servers listen on one port";
  } catch (const Failure& failure) {
    EXPECT_THAT(failure.what(), AllOf(HasSubstr("in use"), HasSubstr("127.0.0.1"),
                                      HasSubstr(std::to_string(first.port()))));
    EXPECT_THAT(failure.hint(), HasSubstr("/daemon/http_address"));
    EXPECT_EQ(failure.exit_code(), ExitCode::configuration);
  }
}

TEST(HttpServer, AddressOfAnotherHostIsRefused) {
  HttpServer server({"192.0.2.1", 0, false});
  EXPECT_THROW(server.start(), Failure);
}

TEST(HttpServer, PortIsFreeAgainAtOnceAfterTheEnd) {
  int port = 0;
  {
    HttpServer server(kAnyPort);
    server.handle("/", [](const HttpRequest&) { return HttpAnswer{200, "a"}; });
    server.start();
    port = server.port();
    EXPECT_EQ(body_of(http_get(port, "/")), "a");
  }
  HttpServer again({"127.0.0.1", port, true});
  EXPECT_NO_THROW(again.start());
}

TEST(HttpServer, ListensOnIPv6) {
  HttpServer server({"::1", 0, true});
  server.handle("/", [](const HttpRequest&) { return HttpAnswer{200, "six"}; });
  try {
    server.start();
  } catch (const Failure&) {
    GTEST_SKIP() << "this host has no IPv6";
  }
  const HttpClient client(server.port(), "::1");
  client.send("GET / HTTP/1.1\r\nHost: [::1]\r\n\r\n");
  EXPECT_EQ(body_of(client.receive()), "six");
}

/// Errors of accepting pass by themselves, as that of a socket which was shut.
TEST(HttpServer, ListensAgainAfterItsSocketFailed) {
  HttpServer server(kAnyPort);
  server.handle("/", [](const HttpRequest&) { return HttpAnswer{200, "back"}; });
  server.start();
  EXPECT_EQ(body_of(http_get(server.port(), "/")), "back");
  ASSERT_TRUE(shut_listening_socket(server.port()));
  for (int round = 0; round < 100; ++round) {
    std::this_thread::sleep_for(50ms);
    try {
      EXPECT_EQ(body_of(http_get(server.port(), "/")), "back");
      return;
    } catch (const std::runtime_error&) {
    }
  }
  FAIL() << "nobody listens";
}

/// A page may be made for longer than the server lives.
TEST(HttpServer, ReplyMayComeAfterItsEnd) {
  std::optional<HttpReply> late;
  std::promise<void> asked;
  std::optional<HttpServer> server(std::in_place, kAnyPort);
  server->handle_deferred("/", [&](const HttpRequest&, const HttpReply& reply) {
    late = reply;
    asked.set_value();
  });
  server->start();
  const HttpClient client(server->port());
  client.send("GET / HTTP/1.0\r\n\r\n");
  asked.get_future().wait();
  EXPECT_TRUE(late->wanted());
  server.reset();
  EXPECT_FALSE(late->wanted());
  late->send(HttpAnswer{200, "too late"});
  EXPECT_EQ(client.receive(), "");
}

}  // namespace
}  // namespace loopscope::daemon
