#include "storage/check_connection.hpp"

#include "storage/password_sources.hpp"
#include "storage/transport_security.hpp"

namespace loopscope::storage {

std::vector<Finding> check_connection(const ConnectionSettings& settings) {
  std::vector<Finding> findings = check_password_sources(settings);
  if (auto transport = check_transport(settings)) findings.push_back(*std::move(transport));
  return findings;
}

}  // namespace loopscope::storage
