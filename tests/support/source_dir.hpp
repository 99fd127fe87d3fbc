#pragma once

#include <filesystem>

namespace loopscope::tests {

/// The checkout that the tests were built from.
[[nodiscard]] std::filesystem::path source_dir();

/// The folder that they were built in.
[[nodiscard]] std::filesystem::path binary_dir();

/// The folder of shared recordings beside the checkout; tests that need it are skipped, visibly,
/// where it does not exist.
[[nodiscard]] std::filesystem::path shared_dir();

/// A fresh folder under the system's temporary one, removed with everything in it at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace loopscope::tests
