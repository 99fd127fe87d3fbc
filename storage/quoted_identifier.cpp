#include "storage/quoted_identifier.hpp"

namespace loopscope::storage {

std::string quoted_identifier(const std::string& name) {
  std::string quoted = "\"";
  for (const char character : name) {
    if (character == '"') quoted += '"';
    quoted += character;
  }
  return quoted + '"';
}

}  // namespace loopscope::storage
