#include "storage/transport_security.hpp"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <cstdint>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "storage/effective_options.hpp"

namespace loopscope::storage {
namespace {

using Options = std::map<std::string, std::string>;

std::string value_of(const Options& options, const std::string& key) {
  const auto found = options.find(key);
  return found == options.end() ? std::string() : found->second;
}

/// The parts of a list of hosts; libpq takes empty ones for "as usual".
std::vector<std::string> parts_of(const std::string& list) {
  std::vector<std::string> parts;
  std::istringstream rest(list);
  for (std::string part; std::getline(rest, part, ',');) parts.push_back(part);
  return parts;
}

bool is_loopback_address(const std::string& host) {
  in_addr v4{};
  if (inet_pton(AF_INET, host.c_str(), &v4) == 1) return (ntohl(v4.s_addr) >> 24U) == 127U;
  in6_addr v6{};
  if (inet_pton(AF_INET6, host.c_str(), &v6) != 1) return false;
  if (IN6_IS_ADDR_V4MAPPED(&v6)) return v6.s6_addr[12] == 127U;
  return IN6_IS_ADDR_LOOPBACK(&v6);
}

/// Unix sockets, loopback addresses, and the one name that stands for them.
bool is_local(const std::string& host) {
  return host.empty() || host.front() == '/' || host.front() == '@' || host == "localhost" ||
         is_loopback_address(host);
}

/// The first host that is not on this machine; empty = none. An address goes before the name.
std::string remote_host(const Options& options) {
  const std::vector<std::string> names = parts_of(value_of(options, "host"));
  const std::vector<std::string> addresses = parts_of(value_of(options, "hostaddr"));
  for (std::size_t k = 0; k < std::max(names.size(), addresses.size()); ++k) {
    const bool has_address = k < addresses.size() && !addresses[k].empty();
    std::string host = has_address ? addresses[k] : k < names.size() ? names[k] : "";
    if (!is_local(host)) return host;
  }
  return {};
}

/// What somebody on the way to the server can do; empty = nothing.
std::string danger_of(const std::string& sslmode) {
  if (sslmode == "verify-full") return {};
  if (sslmode == "verify-ca") {
    return "whoever has a certificate of the same authority can pose as the server";
  }
  if (sslmode == "require") return "anybody on the way can pose as the server";
  return "anybody on the way can read along or pose as the server";
}

}  // namespace

std::optional<Finding> check_transport(const ConnectionSettings& settings) {
  const Options options = effective_options(settings);
  const std::string host = remote_host(options), sslmode = value_of(options, "sslmode");
  const std::string danger = danger_of(sslmode);
  if (host.empty() || danger.empty() || value_of(options, "gssencmode") == "require") {
    return std::nullopt;
  }
  return Finding{true,
                 "the connection to the remote host " + host + " has sslmode=" + sslmode + ": " +
                     danger + ", " + describe_target(settings),
                 "add sslmode=verify-full and sslrootcert=FILE, the certificate of the authority "
                 "that signed the server's, to the connection string or its service",
                 true};
}

}  // namespace loopscope::storage
