#include "config/acknowledge_rules.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/config/settings_text.hpp"

namespace loopscope::config::tests {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kOrigin = R"("origin": "https://loopscope.example")";

std::string with(const std::string& acknowledge, const std::string& more = "",
                 const std::string& results = R"(, "engineer_connection": "service=engineer")") {
  return R"({"results": {"connection": "service=results")" + results +
         R"(}, "historians": [{"connection": "service=plant"}], "daemon": {"acknowledge": {)" +
         acknowledge + "}" + more + "}}";
}

std::string proxies(const std::string& list) {
  return R"("trusted_proxies": [)" + list + "], " + kOrigin;
}

TEST(AcknowledgeRules, IsOffAsLongAsNobodyIsTrusted) {
  EXPECT_THAT(lines_of(with("", "", "")), IsEmpty());
  EXPECT_THAT(lines_of(with(kOrigin, "", "")), IsEmpty());
  EXPECT_FALSE(parse_settings(with(kOrigin), "x").daemon.acknowledge.on());
  EXPECT_TRUE(parse_settings(with(proxies(R"("::1")")), "x").daemon.acknowledge.on());
}

TEST(AcknowledgeRules, ProxiesAreAddressesAndNotEverybody) {
  EXPECT_THAT(lines_of(with(proxies(R"("127.0.0.1", "10.1.0.0/16", "fd00::/8")"))), IsEmpty());
  EXPECT_THAT(lines_of(with(proxies(R"("::1", "proxy.example")"))),
              ElementsAre("/daemon/acknowledge/trusted_proxies/1: is no address and no network"));
  for (const char* all : {"0.0.0.0/0", "::/0", "0.0.0.0"}) {
    EXPECT_THAT(lines_of(with(proxies('"' + std::string(all) + '"'))),
                ElementsAre(HasSubstr("anybody could write in anybody's name")))
        << all;
  }
}

TEST(AcknowledgeRules, TheHeaderIsNoneThatABrowserSets) {
  for (const char* header :
       {"X-Remote-User", "Remote-User", "X-Forwarded-User", "x-webauth-user"}) {
    EXPECT_THAT(lines_of(with(R"("user_header": ")" + std::string(header) + '"')), IsEmpty())
        << header;
  }
  for (const char* header : {"Host", "cookie", "ORIGIN", "Referer", "User-Agent", "Accept-Language",
                             "Sec-Fetch-User", "Content-Type", "X-Forwarded-For", "Authorization",
                             "X_Remote_User", "X Remote", "X:", "Via", "Transfer-Encoding"}) {
    EXPECT_THAT(
        lines_of(with(R"("user_header": ")" + std::string(header) + '"')),
        ElementsAre("/daemon/acknowledge/user_header: is no header that a proxy alone sets"))
        << header;
  }
}

TEST(AcknowledgeRules, WhatIsOnNeedsAnOriginAnAddressAndAnEngineer) {
  const std::string alone = R"("trusted_proxies": ["127.0.0.1"])";
  EXPECT_THAT(lines_of(with(alone)),
              ElementsAre("/daemon/acknowledge/origin: is missing, and trusted_proxies are named"));
  EXPECT_THAT(lines_of(with(proxies(R"("::1")"), "", "")),
              ElementsAre("/results/engineer_connection: is missing, and "
                          "/daemon/acknowledge/trusted_proxies are named"));
  EXPECT_THAT(first_hint_of(with(proxies(R"("::1")"), "", "")), HasSubstr("loopscope_engineer"));
  EXPECT_THAT(lines_of(with(proxies(R"("::1")"), R"(, "http_address": "")")),
              ElementsAre("/daemon/http_address: is empty, and /daemon/acknowledge/trusted_proxies "
                          "are named"));
  EXPECT_THAT(lines_of(with(R"("origin": "https://a.example/")")),
              ElementsAre("/daemon/acknowledge/origin: is no origin as browsers send it"));
}

}  // namespace
}  // namespace loopscope::config::tests
