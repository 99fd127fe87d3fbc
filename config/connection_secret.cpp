#include "config/connection_secret.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <string>

namespace loopscope::config {

namespace {

constexpr std::string_view kBlanks = " \t\n\v\f\r";
constexpr std::string_view kKeyEnds = " \t\n\v\f\r=";
constexpr std::string_view kUriSchemes[] = {"postgresql://", "postgres://"};

/// libpq's own, those of versions to come included.
bool is_secret_key(std::string key) {
  std::transform(key.begin(), key.end(), key.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return key == "password" || key == "sslpassword" || key == "scram_client_key" ||
         key == "scram_server_key" || key == "oauth_client_secret";
}

/// libpq decodes %XX in the keys of a URI too.
std::string percent_decoded(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned char byte = 0;
    const char* digits = text.data() + i + 1;
    if (text[i] == '%' && i + 2 < text.size() &&
        std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
      decoded += static_cast<char>(byte);
      i += 2;
    } else {
      decoded += text[i];
    }
  }
  return decoded;
}

bool uri_holds_secret(std::string_view after_scheme) {
  const std::string_view authority = after_scheme.substr(0, after_scheme.find('/'));
  const std::size_t user_end = authority.find('@');
  if (user_end != std::string_view::npos &&
      percent_decoded(authority.substr(0, user_end)).find(':') != std::string::npos)
    return true;
  std::size_t at = after_scheme.find('?');
  while (at != std::string_view::npos) {
    const std::string_view parameter = after_scheme.substr(at + 1);
    if (is_secret_key(percent_decoded(parameter.substr(0, parameter.find_first_of("=&")))))
      return true;
    at = after_scheme.find('&', at + 1);
  }
  return false;
}

/// The hosts of a URI with their ports: what stands between the user and the database.
std::string_view hosts_of(std::string_view after_scheme) {
  const std::string_view authority = after_scheme.substr(0, after_scheme.find('/'));
  const std::size_t user_end = authority.find('@');
  if (user_end != std::string_view::npos) after_scheme.remove_prefix(user_end + 1);
  return after_scheme.substr(0, after_scheme.find_first_of("/?"));
}

/// Whether something else than digits stands after the host where a port should be.
bool has_odd_port(std::string_view host) {
  const std::size_t address_end = host.starts_with('[') ? host.find(']') : 0;
  const std::size_t colon = host.find(':', std::min(address_end, host.size()));
  return colon != std::string_view::npos &&
         host.find_first_not_of("0123456789", colon + 1) != std::string_view::npos;
}

/// Where the value that starts at `at` ends: quoted or up to a blank, with backslash escapes.
std::size_t value_end(std::string_view text, std::size_t at) {
  const bool quoted = at < text.size() && text[at] == '\'';
  for (at += quoted ? 1 : 0; at < text.size(); ++at) {
    if (text[at] == '\\')
      ++at;
    else if (quoted ? text[at] == '\'' : kBlanks.find(text[at]) != std::string_view::npos)
      return at + 1;
  }
  return text.size();
}

bool keywords_hold_secret(std::string_view text) {
  std::size_t at = text.find_first_not_of(kBlanks);
  while (at != std::string_view::npos) {
    const std::size_t key_end = text.find_first_of(kKeyEnds, at);
    if (is_secret_key(std::string(text.substr(at, key_end - at)))) return true;
    const std::size_t equals = text.find_first_not_of(kBlanks, key_end);
    if (equals == std::string_view::npos) return false;
    at = equals;
    if (text[equals] == '=') {
      const std::size_t value = text.find_first_not_of(kBlanks, equals + 1);
      if (value == std::string_view::npos) return false;
      at = text.find_first_not_of(kBlanks, value_end(text, value));
    }
  }
  return false;
}

}  // namespace

bool holds_secret(std::string_view connection) {
  for (const std::string_view scheme : kUriSchemes)
    if (connection.starts_with(scheme)) return uri_holds_secret(connection.substr(scheme.size()));
  return keywords_hold_secret(connection);
}

bool has_text_for_port(std::string_view connection) {
  for (const std::string_view scheme : kUriSchemes) {
    if (!connection.starts_with(scheme)) continue;
    std::string_view hosts = hosts_of(connection.substr(scheme.size()));
    while (!hosts.empty()) {
      const std::size_t comma = hosts.find(',');
      if (has_odd_port(hosts.substr(0, comma))) return true;
      hosts.remove_prefix(comma == std::string_view::npos ? hosts.size() : comma + 1);
    }
  }
  return false;
}

}  // namespace loopscope::config
