#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>

namespace loopscope::config {

/// A file that cannot be read, is too large, or is no text.
class UnreadableFile : public std::runtime_error {
 public:
  UnreadableFile(const std::string& why, std::string hint)
      : std::runtime_error(why), hint_(std::move(hint)) {}
  [[nodiscard]] const std::string& hint() const { return hint_; }

 private:
  std::string hint_;
};

/// The whole text of a file or a pipe of at most `most_bytes`. Neither a device that never ends nor
/// a pipe that nobody writes to can hold the program up: no more than `most_bytes` is taken, and a
/// pipe or a terminal that is silent for `patience_s` is given up (after 3 s at most where nobody
/// has it open for writing). Throws UnreadableFile; what() is why, without the name.
[[nodiscard]] std::string read_bounded(const std::filesystem::path& file, std::size_t most_bytes,
                                       int patience_s);

}  // namespace loopscope::config
