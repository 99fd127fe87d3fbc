#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace loopscope::config {

/// Where the daemon answers HTTP.
struct HttpAddress {
  std::string host;       ///< an address, never a name; of IPv6 without its brackets
  int port = 0;           ///< 0 = any free one
  bool loopback = false;  ///< only programs of this host can reach it
};

/// Reads "127.0.0.1:9470" or "[::1]:9470"; nullopt = neither. Names are refused: which address a
/// name stands for, and so who can reach the server, may change without the operator's doing.
[[nodiscard]] std::optional<HttpAddress> parse_http_address(std::string_view text);

}  // namespace loopscope::config
