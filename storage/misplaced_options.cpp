#include "storage/misplaced_options.hpp"

#include <arpa/inet.h>
#include <sstream>

#include "storage/error.hpp"

namespace loopscope::storage {
namespace {

/// With or without the zone that a link-local address has ("fe80::1%eth0").
bool is_ipv6(const std::string& host) {
  in6_addr address{};
  return inet_pton(AF_INET6, host.substr(0, host.find('%')).c_str(), &address) == 1;
}

/// A host is a name, an address or the folder of a socket; "@name" is a socket without a file.
bool holds_more(const std::string& host) {
  if (host.starts_with('/')) return false;
  const bool has_colon = host.find(':') != std::string::npos;
  return host.find('@', 1) != std::string::npos || (has_colon && !is_ipv6(host));
}

bool one_holds_more(const std::string& hosts) {
  std::istringstream list(hosts);
  for (std::string host; std::getline(list, host, ',');) {
    if (holds_more(host)) return true;
  }
  return false;
}

/// "user:password@host/database". Names of databases and services with both signs in this order are
/// not worth a password that is shown.
bool holds_login(const std::string& name) {
  const std::size_t colon = name.find(':');
  return colon != std::string::npos && name.find('@', colon) != std::string::npos;
}

/// Another separator than the space has put the options that follow into this one. A service may be
/// called "with_password".
bool holds_options(const std::string& value) {
  for (const std::string word : {"password", "pwd"}) {
    for (auto at = value.find(word); at != std::string::npos; at = value.find(word, at + 1)) {
      const auto next = value.find_first_not_of(' ', at + word.size());
      if (next != std::string::npos && (value[next] == '=' || value[next] == ':')) return true;
    }
  }
  return value.find_first_of(";&") != std::string::npos;
}

[[noreturn]] void refuse(const std::string& option, const std::string& what,
                         const std::string& hint, const std::string& purpose) {
  throw DatabaseError("the connection string: " + option + "= holds " + what +
                          " (not shown, it may hold a password), " + purpose,
                      hint, Remedy::give_up);
}

}  // namespace

void refuse_misplaced(const ConnectionOptions& options, const std::string& purpose) {
  const auto value = [&](const char* option) {
    const auto found = options.find(option);
    return found == options.end() ? std::string() : found->second;
  };
  if (value("dbname").find("://") != std::string::npos)
    refuse("dbname", "a whole connection string",
           "give that string alone, without dbname=", purpose);
  for (const char* option :
       {"host", "hostaddr", "dbname", "user", "service", "sslmode", "target_session_attrs"}) {
    if (holds_options(value(option)))
      refuse(option, "more options than one", "put spaces between options, and none into one",
             purpose);
  }
  for (const char* option : {"dbname", "service"}) {
    if (holds_login(value(option)))
      refuse(option, "more than a name",
             "write host=NAME dbname=NAME user=NAME, and the password into ~/.pgpass", purpose);
  }
  if (value("user").find(':') != std::string::npos)
    refuse("user", "more than a name", "write user=NAME, and the password into ~/.pgpass", purpose);
  for (const char* option : {"host", "hostaddr"}) {
    if (one_holds_more(value(option)))
      refuse(option, "more than a host", "write host=NAME port=NUMBER user=NAME", purpose);
  }
  // "5432:password"; several hosts may have ports of their own.
  if (value("port").find_first_not_of("0123456789, ") != std::string::npos)
    refuse("port", "more than a number", "write port=NUMBER", purpose);
}

}  // namespace loopscope::storage
