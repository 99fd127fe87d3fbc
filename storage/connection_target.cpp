#include "storage/connection_target.hpp"

#include <cstdlib>
#include <libpq-fe.h>
#include <map>
#include <memory>

#include "storage/error.hpp"
#include "storage/explain_error.hpp"
#include "storage/misplaced_options.hpp"

namespace loopscope::storage {
namespace {

using OptionList = std::unique_ptr<PQconninfoOption, decltype(&PQconninfoFree)>;

ConnectionOptions options_of(const OptionList& list) {
  ConnectionOptions options;
  for (const PQconninfoOption* option = list.get(); option && option->keyword; ++option) {
    if (option->val != nullptr && *option->val != '\0') options[option->keyword] = option->val;
  }
  return options;
}

/// What stands in the string itself. complete_conninfo() has refused what cannot be read.
ConnectionOptions own_options(const ConnectionSettings& settings) {
  static_cast<void>(complete_conninfo(settings));
  return options_of({PQconninfoParse(settings.conninfo.c_str(), nullptr), &PQconninfoFree});
}

/// A value as libpq reads it between quotes.
std::string quoted_value(const std::string& value) {
  std::string quoted = "'";
  for (const char character : value) {
    if (character == '\'' || character == '\\') quoted += '\\';
    quoted += character;
  }
  return quoted + "'";
}

/// Only where it has to be quoted: people read what comes of it.
std::string plain_value(const std::string& value) {
  const bool plain = !value.empty() && value.find_first_of(" '\\\t\n\r\f\v") == std::string::npos;
  return plain ? value : quoted_value(value);
}

/// libpq names its usual place only to whoever has no password.
std::string password_file(const std::string& named) {
  const char* home = std::getenv("HOME");
  return !named.empty() || home == nullptr ? named : std::string(home) + "/.pgpass";
}

}  // namespace

ConnectionTarget connection_target(const ConnectionSettings& settings) {
  // Only a connection knows what its service file says. Options are put together in the order of
  // looking at them; no server is asked before all of them were, and this is no sslmode.
  const std::string conninfo = complete_conninfo(settings) + " sslmode='-' password='-'";
  const std::unique_ptr<PGconn, decltype(&PQfinish)> connection(PQconnectStart(conninfo.c_str()),
                                                                &PQfinish);
  const std::string words = connection ? PQerrorMessage(connection.get()) : "";
  if (words.find("sslmode") == std::string::npos)
    throw explain({words, "", false}, {DatabaseKind::results, describe_target(settings), "", ""});
  ConnectionOptions options = options_of({PQconninfo(connection.get()), &PQconninfoFree});
  const std::string& host = options["host"];
  return {host.empty() ? options["hostaddr"] : host, options["port"], options["dbname"],
          options["user"], password_file(options["passfile"])};
}

bool says_user(const ConnectionSettings& settings) {
  const ConnectionOptions options = own_options(settings);
  return options.contains("user") || options.contains("service");
}

std::string with_user(const ConnectionSettings& settings, const std::string& user) {
  ConnectionOptions options = own_options(settings);
  options["user"] = user;
  std::string conninfo;
  const auto add = [&](const std::string& key) {
    const auto found = options.find(key);
    if (found == options.end()) return;
    conninfo += (conninfo.empty() ? "" : " ") + key + "=" + plain_value(found->second);
    options.erase(found);
  };
  for (const char* first : {"service", "host", "hostaddr", "port", "dbname", "user"}) add(first);
  while (!options.empty()) add(options.begin()->first);
  return conninfo;
}

}  // namespace loopscope::storage
