#include "config/http_address.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/settings.hpp"
#include "tests/config/settings_text.hpp"

namespace loopscope::config::tests {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(HttpAddress, IsAnAddressAndAPort) {
  const auto address = parse_http_address("127.0.0.1:9470");
  ASSERT_TRUE(address);
  EXPECT_EQ(address->host, "127.0.0.1");
  EXPECT_EQ(address->port, 9470);
}

TEST(HttpAddress, OfIPv6StandsInBrackets) {
  const auto address = parse_http_address("[::1]:80");
  ASSERT_TRUE(address);
  EXPECT_EQ(address->host, "::1");
  EXPECT_EQ(address->port, 80);
}

TEST(HttpAddress, TellsWhetherOnlyThisHostReachesIt) {
  for (const char* text :
       {"127.0.0.1:1", "127.255.0.9:1", "[::1]:1", "[0:0::1]:1", "[::ffff:127.0.0.1]:1"}) {
    const auto address = parse_http_address(text);
    ASSERT_TRUE(address) << text;
    EXPECT_TRUE(address->loopback) << text;
  }
  for (const char* text : {"0.0.0.0:1", "10.0.0.1:1", "128.0.0.1:1", "[::]:1", "[2001:db8::1]:1",
                           "[::ffff:10.0.0.1]:1", "[::2]:1"}) {
    const auto address = parse_http_address(text);
    ASSERT_TRUE(address) << text;
    EXPECT_FALSE(address->loopback) << text;
  }
}

TEST(HttpAddress, EverythingElseIsRefused) {
  using namespace std::string_view_literals;
  for (const std::string_view text : {""sv,
                                      ":"sv,
                                      ":9470"sv,
                                      "9470"sv,
                                      "127.0.0.1"sv,
                                      "127.0.0.1:"sv,
                                      "127.0.0.1:-1"sv,
                                      "127.0.0.1:+1"sv,
                                      "127.0.0.1:65536"sv,
                                      "127.0.0.1:99999999999"sv,
                                      "127.0.0.1:94 70"sv,
                                      "127.0.0.1: 9470"sv,
                                      " 127.0.0.1:9470"sv,
                                      "127.1:9470"sv,
                                      "127.0.0.256:9470"sv,
                                      "0x7f.0.0.1:9470"sv,
                                      "localhost:9470"sv,
                                      "db.plant.example:9470"sv,
                                      "*:9470"sv,
                                      "::1:9470"sv,
                                      "[::1]"sv,
                                      "[::1]9470"sv,
                                      "[]:9470"sv,
                                      "[127.0.0.1]:9470"sv,
                                      "[::1%lo]:9470"sv,
                                      "[::1:9470"sv,
                                      "127.0.0.1\0:9470"sv,
                                      "127.0.0.1:9470\n"sv,
                                      "http://127.0.0.1:9470"sv,
                                      "127.0.0.1:9470/"sv,
                                      "127.0.0.1:0x10"sv}) {
    EXPECT_FALSE(parse_http_address(text)) << '"' << text << '"';
  }
}

TEST(HttpAddress, DefaultIsOfTheLoopback) {
  const auto address = parse_http_address(DaemonSettings().http_address);
  ASSERT_TRUE(address);
  EXPECT_TRUE(address->loopback);
}

TEST(HttpAddress, MalformedOneIsAProblemOfTheFile) {
  const auto text = [](const std::string& address) {
    return minimal_with(R"("daemon": {"http_address": ")" + address + "\"}");
  };
  EXPECT_THAT(lines_of(text("localhost:9470")),
              ElementsAre("/daemon/http_address: is not an address with a port"));
  EXPECT_THAT(first_hint_of(text("localhost:9470")), HasSubstr("127.0.0.1:9470"));
  EXPECT_THAT(lines_of(text("0.0.0.0:9470")), IsEmpty());
  EXPECT_THAT(lines_of(text("[::1]:0")), IsEmpty());
  EXPECT_THAT(lines_of(text("")), IsEmpty());
}

TEST(HttpAddress, LagHasARange) {
  EXPECT_THAT(lines_of(minimal_with(R"("daemon": {"max_lag_s": 0})")),
              ElementsAre("/daemon/max_lag_s: 0 is out of range, 1 to 2592000 s"));
}

}  // namespace
}  // namespace loopscope::config::tests
