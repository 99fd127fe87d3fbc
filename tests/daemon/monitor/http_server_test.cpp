#include "daemon/monitor/http_server.hpp"

#include <array>
#include <atomic>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iostream>
#include <memory>
#include <random>
#include <thread>
#include <vector>

#include "tests/daemon/monitor/gunzip.hpp"
#include "tests/daemon/monitor/http_client.hpp"
#include "tests/support/sanitized.hpp"

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
    const auto large =
        std::make_shared<const HttpAnswer>(HttpAnswer{200, std::string(4'000'000, 'x')});
    server.handle_deferred(
        "/large", [large](const HttpRequest&, const HttpReply& reply) { reply.send(large); });
    server.handle("/echo", [](const HttpRequest& request) {
      const auto value = request.query.find("q");
      return HttpAnswer{200, value == request.query.end() ? "none" : value->second};
    });
    server.handle_deferred("/never", [](const HttpRequest&, const HttpReply&) {});
    server.handle_deferred("/page", [](const HttpRequest&, const HttpReply& reply) {
      HttpAnswer page{200, std::string(100'000, 'y'), "text/html; charset=utf-8"};
      add_gzipped(page);
      std::thread([reply, page = std::move(page)] { reply.send(page); }).detach();
    });
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

TEST_F(HttpServerTest, DeferredAnswersComeInTheFormThatIsWanted) {
  EXPECT_EQ(body_of(get("/page")), std::string(100'000, 'y'));
  const auto page = [this](const std::string& accept) {
    return answer_to(server.port(), "GET /page HTTP/1.1\r\nHost: [::1]:1\r\nAccept-Encoding: " +
                                        accept + "\r\n\r\n");
  };
  EXPECT_EQ(gunzip(body_of(page("gzip, deflate, br"))), std::string(100'000, 'y'));
  EXPECT_EQ(body_of(page("br, gzip;q=0")), std::string(100'000, 'y'));
  EXPECT_THAT(page("*;q=0"), StartsWith("HTTP/1.1 406 "));
}

TEST_F(HttpServerTest, AnswersToItsOwnNamesOnly) {
  const auto asked = [this](const std::string& host) {
    return answer_to(server.port(), "GET /livez HTTP/1.1\r\nHost: " + host + "\r\n\r\n");
  };
  EXPECT_THAT(asked("evil.example:80"),
              AllOf(StartsWith("HTTP/1.1 421 Misdirected Request\r\n"),
                    HasSubstr("/daemon/http_names"), Not(HasSubstr("evil"))));
  EXPECT_EQ(body_of(asked("127.0.0.1:80")), "ok\n");
  server.use_names({"scada.example"});
  EXPECT_EQ(body_of(asked("scada.example:80")), "ok\n");
  // HTTP/1.0 knows no Host, and what speaks it is no browser.
  EXPECT_EQ(body_of(answer_to(server.port(), "GET /livez HTTP/1.0\r\n\r\n")), "ok\n");
}

TEST_F(HttpServerTest, NothingElseIsThere) {
  for (const char* path :
       {"/", "/livez/", "/livezz", "/loop", "/../etc/passwd", "/livez/../../etc/passwd", "//livez",
        "/%2e%2e/etc/passwd", "/livez%00"}) {
    EXPECT_THAT(get(path), StartsWith("HTTP/1.1 404 ")) << path;
  }
}

TEST_F(HttpServerTest, RefusalsCarryTheSameHeadersAndNothingOfTheRequest) {
  const std::string answer =
      answer_to(server.port(),
                "GET /nowhere<script>evil HTTP/1.1\r\nHost: localhost\r\nX-Mine: evil\r\n\r\n");
  EXPECT_THAT(answer, AllOf(HasSubstr("no-store"), HasSubstr("nosniff"), Not(HasSubstr("evil"))));
  const std::string bad = answer_to(server.port(), "evil\r\n\r\n");
  EXPECT_THAT(bad, AllOf(StartsWith("HTTP/1.1 400 "), HasSubstr("no-store"), HasSubstr("nosniff"),
                         Not(HasSubstr("evil"))));
}

TEST_F(HttpServerTest, OnlyReads) {
  for (const char* method : {"POST", "PUT", "DELETE", "PATCH", "OPTIONS", "TRACE", "CONNECT"}) {
    const std::string answer = answer_to(
        server.port(), std::string(method) +
                           " /livez HTTP/1.1\r\nHost: localhost\r\nContent-Length: 4\r\n\r\nbody");
    EXPECT_THAT(answer, AllOf(StartsWith("HTTP/1.1 405 "), HasSubstr("\r\nAllow: GET, HEAD\r\n"),
                              Not(HasSubstr("body"))))
        << method;
  }
  EXPECT_THAT(answer_to(server.port(), "BREW /livez HTTP/1.1\r\nHost: [::1]\r\n\r\n"),
              StartsWith("HTTP/1.1 405 "));
}

TEST_F(HttpServerTest, HeadHasNoBody) {
  const std::string answer =
      answer_to(server.port(), "HEAD /livez HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_THAT(answer, AllOf(StartsWith("HTTP/1.1 200 "), HasSubstr("Content-Length: 3")));
  EXPECT_EQ(body_of(answer), "");
}

TEST_F(HttpServerTest, FaultOfAHandlerKeepsItsWords) {
  const std::string answer = get("/broken");
  EXPECT_THAT(answer, AllOf(StartsWith("HTTP/1.1 500 "), Not(HasSubstr("secret"))));
}

TEST_F(HttpServerTest, LargeRequestsAreRefused) {
  const std::string long_path =
      "GET /" + std::string(9000, 'a') + " HTTP/1.1\r\nHost: localhost\r\n\r\n";
  EXPECT_THAT(answer_to(server.port(), long_path), StartsWith("HTTP/1.1 414 "));
  std::string many_headers = "GET /livez HTTP/1.1\r\n";
  for (int i = 0; i < 4000; ++i) many_headers += "X-" + std::to_string(i) + ": 0123456789\r\n";
  EXPECT_THAT(answer_to(server.port(), many_headers + "\r\n"), Not(HasSubstr("200 OK")));
  const std::string long_header = "GET / HTTP/1.1\r\nX: " + std::string(kMostHeadBytes, 'a');
  EXPECT_THAT(answer_to(server.port(), long_header), StartsWith("HTTP/1.1 431 "));
  EXPECT_THAT(answer_to(server.port(), std::string(1'000'000, 'a')), Not(HasSubstr("200 OK")));
  EXPECT_EQ(body_of(get("/livez")), "ok\n");
}

TEST_F(HttpServerTest, RangesMultiplyNothing) {
  std::string ranges = "bytes=0-";
  while (ranges.size() < 8000) ranges += ",0-";
  const std::string answer = answer_to(
      server.port(), "GET /livez HTTP/1.1\r\nHost: localhost\r\nRange: " + ranges + "\r\n\r\n");
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 "));
  EXPECT_LT(answer.size(), 1000U);
}

TEST_F(HttpServerTest, SurvivesBytesAtRandom) {
  std::mt19937 random(20260101);  // NOLINT: the same bytes in every run
  std::uniform_int_distribution<int> byte(0, 255);
  std::uniform_int_distribution<int> length(0, 300);
  const std::string start = "GET /livez?q=%41 HTTP/1.1\r\nHost: localhost\r\nRange: bytes=0-1\r\n";
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

/// Twice as many as there are places: some say nothing, some half a request, some do not read.
TEST_F(HttpServerTest, SlowClientsDelayNobody) {
  std::vector<std::unique_ptr<HttpClient>> slow;
  for (std::size_t number = 0; number < 600; ++number) {
    slow.push_back(std::make_unique<HttpClient>(server.port()));
    const std::array<std::string, 3> words = {
        "", "GET /livez HTTP/1.1\r\nX-Slow: ", "GET /large HTTP/1.1\r\nHost: localhost\r\n\r\n"};
    slow.back()->send(words[number % words.size()]);
  }
  const auto start = Clock::now();
  const HttpClient prober(server.port());
  prober.send("GET /livez HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_EQ(body_of(prober.receive(60s)), "ok\n");
  const std::chrono::duration<double> delay = Clock::now() - start;
  std::cout << "answered after " << delay.count() << " s\n";
  // Milliseconds; the rest is the machine's, or a sanitizer's.
  EXPECT_LT(delay, tests::kSanitized ? 60s : 3s);
}

TEST_F(HttpServerTest, WhoWaitsTooLongForAPageIsToldToComeAgain) {
  const auto start = Clock::now();
  EXPECT_THAT(get("/never"), AllOf(StartsWith("HTTP/1.1 503 "), HasSubstr("\r\nRetry-After: 2\r\n"),
                                   HasSubstr("\r\nRefresh: 2\r\n")));
  EXPECT_LT(Clock::now() - start, 8s);
}

TEST_F(HttpServerTest, ClientThatTricklesLosesItsPlaceToo) {
  const HttpClient trickle(server.port());
  trickle.send("GET /livez HTTP/1.1\r\n");
  const auto start = Clock::now();
  while (Clock::now() - start < 8s && trickle.send("X-A: b\r\n"))
    std::this_thread::sleep_for(100ms);
  EXPECT_LT(Clock::now() - start, 7s);
}

TEST_F(HttpServerTest, StopsAtOnceThoughClientsAreOpen) {
  const HttpClient silent(server.port());
  const HttpClient half(server.port());
  half.send("GET /livez HTT");
  const HttpClient waiting(server.port());
  waiting.send("GET /never HTTP/1.1\r\nHost: localhost\r\n\r\n");
  const HttpClient deaf(server.port());
  deaf.send("GET /large HTTP/1.1\r\nHost: localhost\r\n\r\n");
  std::this_thread::sleep_for(50ms);
  const auto start = Clock::now();
  server.stop();
  EXPECT_LT(Clock::now() - start, 2s);
  EXPECT_THROW(HttpClient(server.port()), std::runtime_error);
  server.stop();
}

}  // namespace
}  // namespace loopscope::daemon
