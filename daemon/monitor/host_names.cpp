#include "daemon/monitor/host_names.hpp"

#include <algorithm>
#include <asio/ip/address.hpp>
#include <system_error>

#include "daemon/text/cells.hpp"

namespace loopscope::daemon {
namespace {

/// A dot at the end says only that nothing is to be put behind a name.
std::string_view without_dot(std::string_view name) {
  if (name.ends_with('.')) name.remove_suffix(1);
  return name;
}

/// Whether nothing stands here, or a port.
bool is_port(std::string_view text) {
  return text.empty() ||
         (text.front() == ':' && text.find_first_not_of("0123456789", 1) == std::string_view::npos);
}

bool is_ipv6_literal(std::string_view host) {
  const std::size_t end = host.find(']');
  if (!host.starts_with('[') || end == std::string_view::npos) return false;
  std::error_code error;
  asio::ip::make_address_v6(std::string(host.substr(1, end - 1)), error);
  return !error && is_port(host.substr(end + 1));
}

bool is_ipv4(const std::string& host) {
  std::error_code error;
  asio::ip::make_address_v4(host, error);
  return !error;
}

}  // namespace

bool HostNames::contain(std::string_view host) const {
  if (is_ipv6_literal(host)) return true;
  const std::size_t end = std::min(host.find(':'), host.size());
  if (!is_port(host.substr(end))) return false;
  const std::string_view name = without_dot(host.substr(0, end));
  return same_word(name, "localhost") || is_ipv4(std::string(name)) ||
         std::ranges::any_of(names_, [&](const auto& one) { return same_word(name, one); });
}

}  // namespace loopscope::daemon
