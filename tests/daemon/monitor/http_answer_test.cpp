#include "daemon/monitor/http_answer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/daemon/monitor/gunzip.hpp"

namespace loopscope::daemon {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

HttpRequest wanting(const std::optional<std::string>& accept_encoding) {
  return {"/", {}, "GET", std::nullopt, accept_encoding};
}

std::shared_ptr<const HttpAnswer> page() {
  HttpAnswer answer{200, std::string(5000, 'x'), "text/html; charset=utf-8"};
  answer.headers.emplace("Referrer-Policy", "no-referrer");
  add_gzipped(answer);
  return std::make_shared<const HttpAnswer>(std::move(answer));
}

TEST(HttpAnswer, HeadSaysHowItIsToBeTaken) {
  const HttpMessage message = make_message(page(), wanting(std::nullopt));
  EXPECT_THAT(message.head,
              AllOf(StartsWith("HTTP/1.1 200 OK\r\n"), HasSubstr("\r\nCache-Control: no-store\r\n"),
                    HasSubstr("\r\nX-Content-Type-Options: nosniff\r\n"),
                    HasSubstr("\r\nVary: Accept-Encoding\r\n"),
                    HasSubstr("\r\nContent-Type: text/html; charset=utf-8\r\n"),
                    HasSubstr("\r\nContent-Length: 5000\r\n"),
                    HasSubstr("\r\nReferrer-Policy: no-referrer\r\n"),
                    HasSubstr("\r\nConnection: close\r\n"), EndsWith("\r\n\r\n")));
  EXPECT_THAT(message.head, Not(HasSubstr("Content-Encoding")));
}

TEST(HttpAnswer, PageThatIsThereInBothFormsIsSharedNotCopied) {
  const auto answer = page();
  EXPECT_EQ(make_message(answer, wanting("identity")).body.get(), &answer->body);
  const HttpMessage packed = make_message(answer, wanting("gzip, br"));
  EXPECT_EQ(packed.body.get(), &answer->gzipped);
  EXPECT_THAT(packed.head,
              AllOf(HasSubstr("\r\nContent-Encoding: gzip\r\n"),
                    HasSubstr("Content-Length: " + std::to_string(answer->gzipped.size())),
                    HasSubstr("\r\nVary: Accept-Encoding\r\n")));
  EXPECT_EQ(gunzip(*packed.body), answer->body);
}

TEST(HttpAnswer, SmallOnesAreCompressedForThoseAloneWhoTakeNothingElse) {
  const auto answer = std::make_shared<const HttpAnswer>(HttpAnswer{200, "ok\n"});
  EXPECT_EQ(*make_message(answer, wanting("gzip")).body, "ok\n");
  const HttpMessage packed = make_message(answer, wanting("gzip, identity;q=0"));
  EXPECT_EQ(gunzip(*packed.body), "ok\n");
  EXPECT_THAT(packed.head, HasSubstr("Content-Encoding: gzip"));
}

TEST(HttpAnswer, WhoTakesNeitherIsToldSo) {
  for (const char* header : {"identity;q=0", "*;q=0", "br, identity;q=0"}) {
    const HttpMessage message = make_message(page(), wanting(header));
    EXPECT_THAT(message.head,
                AllOf(StartsWith("HTTP/1.1 406 "), Not(HasSubstr("-Encoding: gzip"))));
    EXPECT_THAT(*message.body, HasSubstr("Accept-Encoding"));
  }
}

TEST(HttpAnswer, RefusalsGoAsTheyAre) {
  const auto refusal = std::make_shared<const HttpAnswer>(HttpAnswer{404, "nothing\n"});
  EXPECT_THAT(make_message(refusal, wanting("*;q=0")).head, StartsWith("HTTP/1.1 404 "));
}

TEST(HttpAnswer, HeadersAloneAreThoseOfTheWholeAnswer) {
  for (const char* header : {"gzip", "identity"}) {
    HttpRequest request = wanting(header);
    const std::string whole = make_message(page(), request).head;
    request.method = "HEAD";
    const HttpMessage message = make_message(page(), request);
    EXPECT_EQ(message.head, whole);
    EXPECT_EQ(*message.body, "");
  }
}

TEST(HttpAnswer, WhatFitsIntoAPacketIsNotCompressed) {
  HttpAnswer answer{503, "not yet\n"};
  add_gzipped(answer);
  EXPECT_EQ(answer.gzipped, "");
}

}  // namespace
}  // namespace loopscope::daemon
