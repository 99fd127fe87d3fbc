#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace loopscope::config {

/// An address with how many of its leading bits count, as 16 bytes: IPv4 as IPv6 writes it
/// (::ffff:a.b.c.d), so that a peer is the same whichever way a socket names it.
struct IpNetwork {
  std::array<std::uint8_t, 16> address{};
  int bits = 0;  ///< of 128; 128 = one address

  /// Whether the address, as text and without a port, lies in it; what is none lies in none. An
  /// address with a zone ("fe80::1%eth0") is none: what it stands for depends on the interface.
  [[nodiscard]] bool contains(const std::string& text) const;
};

/// Reads "10.1.2.3", "10.1.0.0/16", "::1" or "fd00::/8"; nullopt for what is none, or has bits set
/// behind its length ("10.1.2.3/16"): it would not say what was meant. Names are none.
[[nodiscard]] std::optional<IpNetwork> parse_ip_network(std::string_view text);

}  // namespace loopscope::config
