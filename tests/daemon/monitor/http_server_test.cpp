#include "daemon/monitor/http_server.hpp"

#include <atomic>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iostream>
#include <memory>
#include <random>
#include <thread>
#include <vector>

#include "tests/daemon/monitor/http_client.hpp"

namespace loopscope::daemon {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

class HttpServerTest : public testing::Test {
 protected:
  void SetUp() override {
    server.handle("/livez", [](const HttpRequest&) { return HttpAnswer{200, "ok\n"}; });
    server.handle("/readyz", [](const HttpRequest&) { return HttpAnswer{503, "not yet\n"}; });
    server.handle("/broken", [](const HttpRequest&) -> HttpAnswer {
      throw std::runtime_error("password=secret");
    });
    server.handle("/large", [](const HttpRequest&) {
      return HttpAnswer{200, std::string(4'000'000, 'x')};
    });
    server.handle("/echo", [](const HttpRequest& request) {
      const auto value = request.query.find("q");
      return HttpAnswer{200, value == request.query.end() ? "none" : value->second};
    });
    server.handle_below("/loop/", [](const HttpRequest& request) {
      return HttpAnswer{200, "<p>" + request.path + "</p>", "text/html; charset=utf-8"};
    });
    server.handle_below("/loop/list/", [](const HttpRequest&) { return HttpAnswer{200, "list"}; });
    server.start();
  }

  [[nodiscard]] std::string get(const std::string& path) const {
    return http_get(server.port(), path);
  }

  HttpServer server{kAnyPort};
};

TEST_F(HttpServerTest, AnswersWithTheHandlersWords) {
  EXPECT_THAT(get("/livez"),
              AllOf(StartsWith("HTTP/1.1 200 OK\r\n"), HasSubstr("\r\nCache-Control: no-store\r\n"),
                    HasSubstr("\r\nX-Content-Type-Options: nosniff\r\n"),
                    HasSubstr("\r\nContent-Type: text/plain; charset=utf-8\r\n"),
                    HasSubstr("\r\nConnection: close\r\n")));
  EXPECT_EQ(body_of(get("/livez")), "ok\n");
  EXPECT_THAT(get("/readyz"), StartsWith("HTTP/1.1 503 "));
  EXPECT_EQ(body_of(get("/readyz")), "not yet\n");
}

TEST_F(HttpServerTest, QueryIsDecodedAndPathToo) {
  EXPECT_EQ(body_of(get("/echo?q=a%20b%26&q2=c")), "a b&");
  EXPECT_EQ(body_of(get("/live%7A")), "ok\n");
}

TEST_F(HttpServerTest, LongestPrefixAnswersWhatHasNoPathOfItsOwn) {
  EXPECT_EQ(body_of(get("/loop/FIC-101")), "<p>/loop/FIC-101</p>");
  EXPECT_THAT(get("/loop/x"), HasSubstr("Content-Type: text/html; charset=utf-8"));
  EXPECT_EQ(body_of(get("/loop/list/all")), "list");
}

TEST_F(HttpServerTest, NothingElseIsThere) {
  for (const char* path :
       {"/", "/livez/", "/livezz", "/loop", "/../etc/passwd", "/livez/../../etc/passwd", "//livez",
        "/%2e%2e/etc/passwd", "/livez%00"}) {
    EXPECT_THAT(get(path), StartsWith("HTTP/1.1 404 ")) << path;
  }
}

TEST_F(HttpServerTest, RefusalsCarryTheSameHeadersAndNothingOfTheRequest) {
  const std::string answer = answer_to(
      server.port(), "GET /nowhere<script>evil HTTP/1.1\r\nHost: evil\r\nX-Mine: evil\r\n\r\n");
  EXPECT_THAT(answer, AllOf(HasSubstr("no-store"), HasSubstr("nosniff"), Not(HasSubstr("evil"))));
  const std::string bad = answer_to(server.port(), "evil\r\n\r\n");
  EXPECT_THAT(bad, AllOf(StartsWith("HTTP/1.1 400 "), HasSubstr("no-store"), HasSubstr("nosniff"),
                         Not(HasSubstr("evil"))));
}

TEST_F(HttpServerTest, OnlyReads) {
  for (const char* method : {"POST", "PUT", "DELETE", "PATCH", "OPTIONS", "TRACE", "CONNECT"}) {
    const std::string answer = answer_to(
        server.port(),
        std::string(method) + " /livez HTTP/1.1\r\nHost: x\r\nContent-Length: 4\r\n\r\nbody");
    EXPECT_THAT(answer, AllOf(StartsWith("HTTP/1.1 405 "), HasSubstr("\r\nAllow: GET, HEAD\r\n"),
                              Not(HasSubstr("body"))))
        << method;
  }
  EXPECT_THAT(answer_to(server.port(), "BREW /livez HTTP/1.1\r\nHost: x\r\n\r\n"),
              StartsWith("HTTP/1.1 400 "));
}

TEST_F(HttpServerTest, HeadHasNoBody) {
  const std::string answer = answer_to(server.port(), "HEAD /livez HTTP/1.1\r\nHost: x\r\n\r\n");
  EXPECT_THAT(answer, AllOf(StartsWith("HTTP/1.1 200 "), HasSubstr("Content-Length: 3")));
  EXPECT_EQ(body_of(answer), "");
}

TEST_F(HttpServerTest, FaultOfAHandlerKeepsItsWords) {
  const std::string answer = get("/broken");
  EXPECT_THAT(answer, AllOf(StartsWith("HTTP/1.1 500 "), Not(HasSubstr("secret"))));
}

TEST_F(HttpServerTest, LargeRequestsAreRefused) {
  const std::string long_path = "GET /" + std::string(9000, 'a') + " HTTP/1.1\r\n\r\n";
  EXPECT_THAT(answer_to(server.port(), long_path), StartsWith("HTTP/1.1 414 "));
  std::string many_headers = "GET /livez HTTP/1.1\r\n";
  for (int i = 0; i < 4000; ++i) many_headers += "X-" + std::to_string(i) + ": 0123456789\r\n";
  EXPECT_THAT(answer_to(server.port(), many_headers + "\r\n"), Not(HasSubstr("200 OK")));
  EXPECT_THAT(answer_to(server.port(), std::string(1'000'000, 'a')), Not(HasSubstr("200 OK")));
  EXPECT_EQ(body_of(get("/livez")), "ok\n");
}

TEST_F(HttpServerTest, RangesMultiplyNothing) {
  std::string ranges = "bytes=0-";
  while (ranges.size() < 8000) ranges += ",0-";
  const std::string answer =
      answer_to(server.port(), "GET /livez HTTP/1.1\r\nHost: x\r\nRange: " + ranges + "\r\n\r\n");
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 "));
  EXPECT_LT(answer.size(), 1000U);
}

TEST_F(HttpServerTest, SurvivesBytesAtRandom) {
  std::mt19937 random(20260101);  // NOLINT: the same bytes in every run
  std::uniform_int_distribution<int> byte(0, 255);
  std::uniform_int_distribution<int> length(0, 300);
  const std::string start = "GET /livez?q=%41 HTTP/1.1\r\nHost: x\r\nRange: bytes=0-1\r\n";
  for (int round = 0; round < 1000; ++round) {
    std::string request = start.substr(0, static_cast<std::size_t>(length(random)) % start.size());
    for (int i = length(random); i > 0; --i) request += static_cast<char>(byte(random));
    HttpClient(server.port()).send(request + "\r\n\r\n");
    // Now and then an answer is waited for: no faster than it serves.
    if (round % 20 == 19) {
      EXPECT_EQ(body_of(get("/livez")), "ok\n") << round;
    }
  }
}

TEST_F(HttpServerTest, LargeAnswersArriveWhole) {
  EXPECT_EQ(body_of(get("/large")).size(), 4'000'000U);
}

TEST_F(HttpServerTest, ManyClientsAtOnceAllGetTheirAnswer) {
  std::atomic<int> answered = 0;
  std::vector<std::jthread> clients;
  for (int client = 0; client < 16; ++client) {
    clients.emplace_back([&] {
      for (int round = 0; round < 20; ++round) {
        if (body_of(get("/livez")) == "ok\n") ++answered;
      }
    });
  }
  clients.clear();
  EXPECT_EQ(answered, 16 * 20);
}

/// As many that never end their request, each kept open, as would take every thread many times.
TEST_F(HttpServerTest, SlowClientsDoNotStarveTheOthers) {
  std::vector<std::unique_ptr<HttpClient>> slow;
  for (int number = 0; number < 24; ++number) {
    slow.push_back(std::make_unique<HttpClient>(server.port()));
    slow.back()->send(number % 2 == 0 ? "GET /livez HTTP/1.1\r\nX-Slow: " : "");
  }
  const auto start = Clock::now();
  EXPECT_EQ(body_of(get("/livez")), "ok\n");
  // 24 before it, four threads, a quarter of a second each: 1.5 s; the rest is the machine's.
  const std::chrono::duration<double> delay = Clock::now() - start;
  std::cout << "answered after " << delay.count() << " s\n";
  EXPECT_LT(delay, 3s);
}

TEST_F(HttpServerTest, ClientThatTricklesLosesItsPlaceToo) {
  const HttpClient trickle(server.port());
  trickle.send("GET /livez HTTP/1.1\r\n");
  const auto start = Clock::now();
  while (Clock::now() - start < 8s && trickle.send("X-A: b\r\n"))
    std::this_thread::sleep_for(100ms);
  EXPECT_LT(Clock::now() - start, 7s);
}

TEST_F(HttpServerTest, ClientThatDoesNotReadHoldsNoThreadForEver) {
  std::vector<std::unique_ptr<HttpClient>> deaf;
  for (int number = 0; number < 8; ++number) {
    deaf.push_back(std::make_unique<HttpClient>(server.port()));
    deaf.back()->send("GET /large HTTP/1.1\r\nHost: x\r\n\r\n");
  }
  const auto start = Clock::now();
  EXPECT_EQ(body_of(get("/livez")), "ok\n");
  EXPECT_LT(Clock::now() - start, 4s);
}

TEST_F(HttpServerTest, StopsAtOnceThoughClientsAreOpen) {
  const HttpClient silent(server.port());
  const HttpClient half(server.port());
  half.send("GET /livez HTT");
  std::this_thread::sleep_for(50ms);
  const auto start = Clock::now();
  server.stop();
  EXPECT_LT(Clock::now() - start, 2s);
  EXPECT_THROW(HttpClient(server.port()), std::runtime_error);
  server.stop();
}

}  // namespace
}  // namespace loopscope::daemon
