#include "config/web_origin.hpp"

#include <algorithm>
#include <string>

#include "config/host_name.hpp"
#include "config/http_address.hpp"

namespace loopscope::config {
namespace {

/// A name, or an address; of IPv6 in brackets.
bool is_host(std::string_view host) {
  return is_host_name(host) || parse_http_address(std::string(host) + ":0").has_value();
}

bool is_port(std::string_view text, std::string_view usual) {
  return text != usual && !text.starts_with('0') &&
         parse_http_address("127.0.0.1:" + std::string(text)).has_value();
}

bool is_authority(std::string_view text, std::string_view usual_port) {
  const std::size_t bracket = text.starts_with('[') ? std::min(text.find(']'), text.size()) : 0;
  const std::size_t colon = std::min(text.find(':', bracket), text.size());
  if (colon < text.size() && !is_port(text.substr(colon + 1), usual_port)) return false;
  return is_host(text.substr(0, colon));
}

}  // namespace

bool is_web_origin(std::string_view text) {
  constexpr std::string_view kPlain = "http://";
  constexpr std::string_view kSecure = "https://";
  if (std::ranges::any_of(text, [](char c) { return c >= 'A' && c <= 'Z'; })) return false;
  if (text.starts_with(kSecure)) return is_authority(text.substr(kSecure.size()), "443");
  return text.starts_with(kPlain) && is_authority(text.substr(kPlain.size()), "80");
}

}  // namespace loopscope::config
