#include "config/http_address.hpp"

#include <arpa/inet.h>
#include <charconv>

namespace loopscope::config {
namespace {

constexpr int kMostPort = 65535;

std::optional<int> parse_port(std::string_view text) {
  int port = -1;
  const char* end = text.data() + text.size();
  const auto [read, error] = std::from_chars(text.data(), end, port);
  const bool digits_alone = error == std::errc() && read == end && text.front() != '-';
  return digits_alone && port <= kMostPort ? std::optional(port) : std::nullopt;
}

bool is_loopback(const in_addr& address) {
  constexpr unsigned kLoopbackNet = 127;
  return ntohl(address.s_addr) >> 24 == kLoopbackNet;
}

/// ::1, or 127.x.x.x written as an IPv6 address.
bool is_loopback(const in6_addr& address) {
  if (IN6_IS_ADDR_LOOPBACK(&address)) return true;
  return IN6_IS_ADDR_V4MAPPED(&address) && address.s6_addr[12] == 127;
}

/// Whether the text is an address of its family, and one of the loopback.
template <typename Address>
std::optional<bool> loopback_of(int family, const std::string& host) {
  // inet_pton stops at a zero byte.
  if (host.find('\0') != std::string::npos) return std::nullopt;
  Address address{};
  if (inet_pton(family, host.c_str(), &address) != 1) return std::nullopt;
  return is_loopback(address);
}

}  // namespace

std::optional<HttpAddress> parse_http_address(std::string_view text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos || colon + 1 == text.size()) return std::nullopt;
  std::string_view host = text.substr(0, colon);
  const std::optional<int> port = parse_port(text.substr(colon + 1));
  const bool bracketed = host.size() > 2 && host.front() == '[' && host.back() == ']';
  if (bracketed) host = host.substr(1, host.size() - 2);
  HttpAddress address{std::string(host), port.value_or(0)};
  const std::optional<bool> loopback = bracketed ? loopback_of<in6_addr>(AF_INET6, address.host)
                                                 : loopback_of<in_addr>(AF_INET, address.host);
  if (!port || !loopback) return std::nullopt;
  address.loopback = *loopback;
  return address;
}

}  // namespace loopscope::config
