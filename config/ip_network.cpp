#include "config/ip_network.hpp"

#include <algorithm>
#include <arpa/inet.h>
#include <charconv>

namespace loopscope::config {
namespace {

using Bytes = std::array<std::uint8_t, 16>;

constexpr int kBitsOfByte = 8;
constexpr int kAllBits = 128;
constexpr int kBitsBeforeIpv4 = 96;
constexpr std::size_t kBytesBeforeIpv4 = 12;
constexpr std::uint8_t kAllSet = 0xFF;

struct Address {
  Bytes bytes{};
  bool ipv4 = false;
};

std::optional<Address> parse_address(const std::string& text) {
  // inet_pton stops at a zero byte.
  if (text.find('\0') != std::string::npos) return std::nullopt;
  Address address;
  if (inet_pton(AF_INET6, text.c_str(), address.bytes.data()) == 1) return address;
  address.bytes = {};
  address.bytes[kBytesBeforeIpv4 - 2] = address.bytes[kBytesBeforeIpv4 - 1] = kAllSet;
  address.ipv4 = true;
  if (inet_pton(AF_INET, text.c_str(), address.bytes.data() + kBytesBeforeIpv4) != 1)
    return std::nullopt;
  return address;
}

/// Whether the two agree in their first bits.
bool agree(const Bytes& a, const Bytes& b, int bits) {
  const auto whole = static_cast<std::size_t>(bits / kBitsOfByte);
  if (!std::equal(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(whole), b.begin()))
    return false;
  const int rest = bits % kBitsOfByte;
  return rest == 0 || (a[whole] ^ b[whole]) >> (kBitsOfByte - rest) == 0;
}

bool is_clear_behind(const Bytes& address, int bits) {
  for (int bit = bits; bit < kAllBits; ++bit) {
    const int byte = address[static_cast<std::size_t>(bit / kBitsOfByte)];
    if ((byte >> (kBitsOfByte - 1 - bit % kBitsOfByte) & 1) != 0) return false;
  }
  return true;
}

/// Digits alone, at most `most`.
std::optional<int> parse_bits(std::string_view text, int most) {
  int bits = 0;
  const char* end = text.data() + text.size();
  const auto [read, error] = std::from_chars(text.data(), end, bits);
  const bool whole = error == std::errc() && read == end && text.front() != '-';
  return whole && bits <= most ? std::optional(bits) : std::nullopt;
}

}  // namespace

bool IpNetwork::contains(const std::string& text) const {
  const std::optional<Address> other = parse_address(text);
  return other && agree(address, other->bytes, bits);
}

std::optional<IpNetwork> parse_ip_network(std::string_view text) {
  const std::size_t slash = std::min(text.find('/'), text.size());
  const std::optional<Address> address = parse_address(std::string(text.substr(0, slash)));
  if (!address) return std::nullopt;
  if (slash == text.size()) return IpNetwork{address->bytes, kAllBits};
  const int before = address->ipv4 ? kBitsBeforeIpv4 : 0;
  const std::optional<int> bits = parse_bits(text.substr(slash + 1), kAllBits - before);
  if (!bits || !is_clear_behind(address->bytes, before + *bits)) return std::nullopt;
  return IpNetwork{address->bytes, before + *bits};
}

}  // namespace loopscope::config
