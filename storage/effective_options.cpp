#include "storage/effective_options.hpp"

#include <libpq-fe.h>
#include <memory>

namespace loopscope::storage {

std::map<std::string, std::string> effective_options(const ConnectionSettings& settings) {
  // Only a connection knows what its service file says. This one ends before a name is looked up,
  // because no server has port 0, and with a password at hand libpq looks for none.
  const std::string conninfo = complete_conninfo(settings) + " port='0' password='-'";
  const std::unique_ptr<PGconn, decltype(&PQfinish)> connection(PQconnectStart(conninfo.c_str()),
                                                                &PQfinish);
  const std::unique_ptr<PQconninfoOption, decltype(&PQconninfoFree)> found(
      PQconninfo(connection.get()), &PQconninfoFree);
  std::map<std::string, std::string> options;
  for (const PQconninfoOption* option = found.get(); option && option->keyword; ++option) {
    if (option->val != nullptr && *option->val != '\0') options[option->keyword] = option->val;
  }
  for (const char* ours : {"port", "password", "sslpassword"}) options.erase(ours);
  return options;
}

}  // namespace loopscope::storage
