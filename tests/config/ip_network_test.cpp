#include "config/ip_network.hpp"

#include <gtest/gtest.h>

namespace loopscope::config::tests {
namespace {

bool contains(std::string_view network, const std::string& address) {
  const auto parsed = parse_ip_network(network);
  EXPECT_TRUE(parsed) << network;
  return parsed && parsed->contains(address);
}

TEST(IpNetwork, AnAddressIsItselfAlone) {
  EXPECT_TRUE(contains("127.0.0.1", "127.0.0.1"));
  EXPECT_FALSE(contains("127.0.0.1", "127.0.0.2"));
  EXPECT_TRUE(contains("::1", "0:0::1"));
  EXPECT_FALSE(contains("::1", "127.0.0.1"));
}

TEST(IpNetwork, AddressesAreTheSameWhicheverWayASocketNamesThem) {
  EXPECT_TRUE(contains("10.1.2.3", "::ffff:10.1.2.3"));
  EXPECT_TRUE(contains("::ffff:10.1.2.3", "10.1.2.3"));
  EXPECT_TRUE(contains("10.1.0.0/16", "::ffff:a01:ffff"));
  EXPECT_FALSE(contains("10.1.0.0/16", "::10.1.2.3"));
}

TEST(IpNetwork, BitsSayHowFarItReaches) {
  EXPECT_TRUE(contains("10.1.0.0/16", "10.1.255.255"));
  EXPECT_FALSE(contains("10.1.0.0/16", "10.2.0.0"));
  EXPECT_TRUE(contains("192.168.4.0/23", "192.168.5.1"));
  EXPECT_FALSE(contains("192.168.4.0/23", "192.168.6.1"));
  EXPECT_TRUE(contains("fd00::/8", "fdab::1"));
  EXPECT_FALSE(contains("fd00::/8", "fe80::1"));
  EXPECT_TRUE(contains("0.0.0.0/0", "8.8.8.8"));
  EXPECT_FALSE(contains("0.0.0.0/0", "fdab::1"));
}

TEST(IpNetwork, WhatIsNoneIsInNoneAndIsNone) {
  for (const char* text : {"", "localhost", "10.1.2", "10.1.2.3/33", "10.1.2.3/", "10.1.2.3/-1",
                           "10.1.2.3/16", "::1/129", "::1/64", "10.1.2.3:80", "[::1]", "1e1.1.1.1",
                           "fe80::1%lo", "10.0.0.0/8/8", "10.0.0.0/ 8", " 10.0.0.1", "0x7f.0.0.1"})
    EXPECT_FALSE(parse_ip_network(text)) << text;
  EXPECT_FALSE(parse_ip_network(std::string_view("10.0.0.1\0", 9)));
  for (const char* text : {"", "unknown", "fe80::1%lo", "10.1.2.3:80"})
    EXPECT_FALSE(contains("0.0.0.0/0", text)) << text;
}

}  // namespace
}  // namespace loopscope::config::tests
