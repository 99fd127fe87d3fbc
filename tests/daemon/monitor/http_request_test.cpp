#include "daemon/monitor/http_request.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

using testing::ElementsAre;
using testing::Optional;
using testing::Pair;

/// Throws std::bad_variant_access where it is refused.
HttpRequest read(const std::string& head) {
  return std::get<HttpRequest>(parse_request(head + "\r\n\r\n"));
}

/// 0 = not refused.
int refusal(const std::string& head) {
  const auto parsed = parse_request(head + "\r\n\r\n");
  const auto* status = std::get_if<HttpRefusal>(&parsed);
  return status == nullptr ? 0 : *status;
}

TEST(HttpRequest, IsPathQueryAndTheHeadersThatCount) {
  const HttpRequest request = read(
      "HEAD /loop%2Fa?name=a%20b%26+c&x&=y&&q=1=2 HTTP/1.1\r\nhost:  here:1 \r\n"
      "ACCEPT-encoding: gzip;q=0.5, br\r\nCookie: none");
  EXPECT_EQ(request.method, "HEAD");
  EXPECT_EQ(request.path, "/loop/a");
  EXPECT_THAT(request.query,
              ElementsAre(Pair("", "y"), Pair("name", "a b& c"), Pair("q", "1=2"), Pair("x", "")));
  EXPECT_THAT(request.host, Optional(std::string("here:1")));
  EXPECT_THAT(request.accept_encoding, Optional(std::string("gzip;q=0.5, br")));
  EXPECT_EQ(read("GET /?a HTTP/1.0").host, std::nullopt);
  EXPECT_EQ(read("GET / HTTP/1.1\r\nHost: x").accept_encoding, std::nullopt);
  EXPECT_THAT(read("GET / HTTP/1.1\r\nHost: x\r\nAccept-Encoding:").accept_encoding,
              Optional(std::string()));
}

TEST(HttpRequest, EveryMethodIsReadSinceRoutesRefuseThem) {
  EXPECT_EQ(read("BREW / HTTP/1.1\r\nHost: x").method, "BREW");
  EXPECT_EQ(read("POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 99999999999").method, "POST");
}

TEST(HttpRequest, NewerProtocolNamesExactlyOneHost) {
  EXPECT_EQ(refusal("GET / HTTP/1.1"), 400);
  EXPECT_EQ(refusal("GET / HTTP/1.1\r\nHost: a\r\nHost: b"), 400);
  EXPECT_EQ(refusal("GET / HTTP/1.0\r\nHost: a\r\nHost: b"), 400);
  EXPECT_EQ(refusal("GET / HTTP/1.0"), 0);
  EXPECT_THAT(read("GET / HTTP/1.1\r\nHost:").host, Optional(std::string()));
}

TEST(HttpRequest, WhatIsNoneIsRefused) {
  for (const char* head :
       {"", "evil", "GET", "GET /", "GET / HTTP/2.0\r\nHost: x", "GET / HTTP/1.1\r\nHost x",
        "GET / HTTP/1.1\r\nHost: x\r\nA\x01: b", "GET / HTTP/1.1\r\nHost: x\r\nA: \x01",
        "GET / HTTP/1.1\r\nHost: x\r\n: b", "PRI * HTTP/2.0\r\n\r\nSM", "GET / HTTP/1.1\nHost: x",
        "GET / HTTP/1.1\r\nHost: x\r\nContent-Length: -1"})
    EXPECT_EQ(refusal(head), 400) << head;
  EXPECT_EQ(refusal("GET / HTTP/1.1\r\nHost: x\r\nA: " + std::string(1, '\0')), 400);
}

TEST(HttpRequest, LongTargetsAreRefused) {
  const std::string end = " HTTP/1.1\r\nHost: x";
  EXPECT_EQ(refusal("GET /" + std::string(kMostTargetBytes - 1, 'a') + end), 0);
  EXPECT_EQ(refusal("GET /" + std::string(kMostTargetBytes, 'a') + end), 414);
}

/// A header of many parts is one text here: no part of it is taken apart by recursion.
TEST(HttpRequest, LongHeaderLinesAreJustLong) {
  const std::string blanks(8125, ' ');
  EXPECT_EQ(refusal("GET / HTTP/1.1\r\nHost: x\r\nRange: bytes=1-2," + blanks + "3-4"), 0);
  EXPECT_EQ(refusal("GET / HTTP/1.1\r\nHost: x\r\nA: " + std::string(kMostHeadBytes, 'a')), 400);
}

TEST(HttpRequest, DecodingLeavesWhatIsNoEscape) {
  EXPECT_EQ(percent_decoded("%41%2f%2F%00b", false), std::string("A//\0b", 5));
  for (const char* text : {"%", "%4", "%zz", "%4z", "%-1", "% 1", "a%"})
    EXPECT_EQ(percent_decoded(text, false), text);
  EXPECT_EQ(percent_decoded("a+b%2B", true), "a b+");
  EXPECT_EQ(percent_decoded("a+b%2B", false), "a+b+");
}

}  // namespace
}  // namespace loopscope::daemon
