#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <thread>

#include "daemon/monitor/form_head.hpp"
#include "daemon/monitor/http_server.hpp"
#include "tests/daemon/monitor/http_client.hpp"

/// Forms over real sockets.
namespace loopscope::daemon {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using namespace std::chrono_literals;

class HttpForm : public testing::Test {
 protected:
  void SetUp() override {
    server.handle_form("/form", {[this] { return open.load(); },
                                 [](const HttpRequest& request) -> std::optional<HttpAnswer> {
                                   if (request.values("X-Who").empty()) return std::nullopt;
                                   return HttpAnswer{403, "not you\n"};
                                 },
                                 [this](const HttpRequest& request, const HttpReply& reply) {
                                   ++answered;
                                   reply.send(HttpAnswer{200, request.from + ' ' + request.body});
                                 }});
    server.start();
  }
  [[nodiscard]] static std::string head(const std::string& length, const std::string& more = "") {
    return "POST /form HTTP/1.1\r\nHost: localhost\r\nContent-Type: "
           "application/x-www-form-urlencoded\r\nContent-Length: " +
           length + "\r\n" + more + "\r\n";
  }
  [[nodiscard]] std::string ask(const std::string& request) const {
    return answer_to(server.port(), request);
  }

  std::atomic<bool> open = true;
  std::atomic<int> answered = 0;
  HttpServer server{kAnyPort};
};

TEST_F(HttpForm, ABodyIsReadAsLongAsItSays) {
  EXPECT_EQ(body_of(ask(head("3") + "a=b")), "127.0.0.1 a=b");
  EXPECT_EQ(body_of(ask(head("0"))), "127.0.0.1 ");
  const std::string most(kMostFormBytes, 'x');
  EXPECT_EQ(body_of(ask(head(std::to_string(kMostFormBytes)) + most)), "127.0.0.1 " + most);
}

TEST_F(HttpForm, ItComesInPieces) {
  const HttpClient client(server.port());
  const std::string request = head("10") + "0123456789";
  for (std::size_t i = 0; i < request.size(); i += 40) {
    client.send(request.substr(i, 40));
    std::this_thread::sleep_for(5ms);
  }
  EXPECT_EQ(body_of(client.receive()), "127.0.0.1 0123456789");
}

/// One connection, one answer: what stands behind the body is no request.
TEST_F(HttpForm, WhatFollowsIsNotAnswered) {
  const std::string answer = ask(head("3") + "a=b" + head("3") + "c=d");
  EXPECT_EQ(body_of(answer), "127.0.0.1 a=b");
  EXPECT_EQ(answered, 1);
}

TEST_F(HttpForm, WhoWaitsToGoOnIsTold) {
  const HttpClient client(server.port());
  client.send(head("3", "Expect: 100-continue\r\n"));
  EXPECT_THAT(client.receive(300ms), StartsWith("HTTP/1.1 100 Continue\r\n\r\n"));
  client.send("a=b");
  EXPECT_EQ(body_of(client.receive()), "127.0.0.1 a=b");
  EXPECT_THAT(ask(head("3", "Expect: 100-continue\r\n") + "a=b"), StartsWith("HTTP/1.1 200 "));
}

TEST_F(HttpForm, WhoIsRefusedByHisHeadSendsNoBody) {
  EXPECT_THAT(ask(head("3", "X-Who: me\r\nExpect: 100-continue\r\n")),
              AllOf(StartsWith("HTTP/1.1 403 "), Not(HasSubstr("100 Continue"))));
  EXPECT_THAT(ask(head("3", "Transfer-Encoding: chunked\r\n") + "a=b"),
              StartsWith("HTTP/1.1 400 "));
  EXPECT_THAT(ask(head("3", "Content-Length: 4\r\n") + "a=b"), StartsWith("HTTP/1.1 400 "));
  EXPECT_THAT(ask(head("8193") + std::string(8193, 'x')), StartsWith("HTTP/1.1 413 "));
  std::string foreign = head("3") + "a=b";
  foreign.replace(foreign.find("localhost"), 9, "evil.test");
  EXPECT_THAT(ask(foreign), StartsWith("HTTP/1.1 421 "));
  open = false;
  EXPECT_THAT(ask(head("3") + "a=b"),
              AllOf(StartsWith("HTTP/1.1 405 "), HasSubstr("\r\nAllow: GET, HEAD\r\n")));
  EXPECT_THAT(http_get(server.port(), "/form"), StartsWith("HTTP/1.1 404 "));
  EXPECT_EQ(answered, 0);
}

TEST_F(HttpForm, HalfAFormIsNone) {
  const HttpClient half(server.port());
  half.send(head("10") + "01234");
  {
    const HttpClient gone(server.port());
    gone.send(head("10") + "01234");
  }
  EXPECT_EQ(body_of(ask(head("3") + "a=b")), "127.0.0.1 a=b") << "others do not wait for it";
  EXPECT_EQ(half.receive(8s), "") << "it is closed";
  EXPECT_EQ(answered, 1);
}

}  // namespace
}  // namespace loopscope::daemon
