#include "daemon/report/annotate/form_gate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/hostile_names.hpp"

namespace loopscope::daemon {
namespace {

using testing::HasSubstr;
using testing::Not;

const config::AcknowledgeSettings kSettings{
    {"127.0.0.1", "10.1.0.0/16"}, "X-Remote-User", "https://loopscope.example"};

HttpRequest request(const std::string& user = "anna", const std::string& from = "10.1.2.3") {
  HttpRequest one{"/annotate", {}};
  one.from = from;
  one.headers = {{"x-remote-USER", user}};
  return one;
}

HttpRequest post(const std::string& origin = kSettings.origin) {
  HttpRequest one = request();
  one.method = "POST";
  one.headers.emplace_back("Origin", origin);
  return one;
}

/// "" = refused.
std::string user_of(const HttpRequest& one) {
  const auto user = signed_in_user(one, kSettings);
  return std::holds_alternative<std::string>(user) ? std::get<std::string>(user) : "";
}

TEST(FormGate, WhoAsksIsWhomATrustedProxyNames) {
  EXPECT_EQ(user_of(request()), "anna");
  EXPECT_EQ(user_of(request("J. M\u00fcller", "::ffff:10.1.255.1")), "J. M\u00fcller");
  for (const char* from : {"10.2.0.1", "127.0.0.2", "::1", "", "::10.1.2.3"})
    EXPECT_EQ(user_of(request("anna", from)), "") << from;
  HttpRequest forwarded = request("anna", "10.2.0.1");
  forwarded.headers.emplace_back("X-Forwarded-For", "10.1.2.3");
  EXPECT_EQ(user_of(forwarded), "");
}

TEST(FormGate, ANameIsSaidOnceInPrintableText) {
  HttpRequest two = request();
  two.headers.emplace_back("X-Remote-User", "anna");
  EXPECT_EQ(user_of(two), "");
  EXPECT_EQ(user_of({"/annotate", {}}), "");
  EXPECT_EQ(user_of(request(std::string(kMostUserBytes, 'n'))).size(), kMostUserBytes);
  EXPECT_EQ(user_of(request(std::string(kMostUserBytes + 1, 'n'))), "");
  for (const tests::HostileName& name : tests::impossible_names())
    EXPECT_EQ(user_of(request(name.name)), "") << name.about;
  for (const char* name : {"", " ", "a\nb", "\x1b[2J", "\u202eanna", "an\u200bna"})
    EXPECT_EQ(user_of(request(name)), "") << name;
}

TEST(FormGate, WhatIsMissingIsSaidWithoutAddressesAndHeaders) {
  EXPECT_THAT(std::get<HttpAnswer>(signed_in_user(request("anna", "8.8.8.8"), kSettings)).body,
              testing::AllOf(HasSubstr("proxy that signs people in"), Not(HasSubstr("10.1")),
                             Not(HasSubstr("Remote-User"))));
}

TEST(FormGate, AFormComesFromAPageOfThisAddress) {
  EXPECT_FALSE(form_refusal(request(), kSettings));
  EXPECT_FALSE(form_refusal(post(), kSettings));
  HttpRequest none = request();
  none.method = "POST";
  EXPECT_TRUE(form_refusal(none, kSettings));
  for (const char* origin :
       {"null", "", "http://loopscope.example", "https://loopscope.example:443",
        "https://loopscope.example.evil", "https://LOOPSCOPE.example"})
    EXPECT_TRUE(form_refusal(post(origin), kSettings)) << origin;
  HttpRequest two = post();
  two.headers.emplace_back("Origin", kSettings.origin);
  EXPECT_TRUE(form_refusal(two, kSettings));
  for (const char* site : {"cross-site", "same-site", "none", "same-origin, cross-site"}) {
    HttpRequest foreign = post();
    foreign.headers.emplace_back("Sec-Fetch-Site", site);
    EXPECT_TRUE(form_refusal(foreign, kSettings)) << site;
  }
  HttpRequest own = post();
  own.headers.emplace_back("Sec-Fetch-Site", "same-origin");
  EXPECT_FALSE(form_refusal(own, kSettings));
}

TEST(FormGate, ThePageIsNoPartOfAnother) {
  for (const char* part : {"iframe", "image", "script", "empty"}) {
    HttpRequest one = request();
    one.headers.emplace_back("Sec-Fetch-Dest", part);
    EXPECT_TRUE(form_refusal(one, kSettings)) << part;
  }
  HttpRequest whole = request();
  whole.headers.emplace_back("Sec-Fetch-Dest", "document");
  EXPECT_FALSE(form_refusal(whole, kSettings));
}

}  // namespace
}  // namespace loopscope::daemon
