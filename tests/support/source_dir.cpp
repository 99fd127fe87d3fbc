#include "tests/support/source_dir.hpp"

#include <stdexcept>
#include <stdlib.h>
#include <string>

namespace loopscope::tests {

std::filesystem::path source_dir() {
  return LOOPSCOPE_SOURCE_DIR;
}

std::filesystem::path binary_dir() {
  return LOOPSCOPE_BINARY_DIR;
}

std::filesystem::path shared_dir() {
  return source_dir().parent_path() / "shared";
}

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "loopscope-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) {
    throw std::runtime_error("no temporary folder could be made");
  }
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace loopscope::tests
