#include "config/read_bounded.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fcntl.h>
#include <poll.h>
#include <string_view>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace loopscope::config {

namespace {

constexpr std::size_t kChunkBytes = std::size_t{256} * 1024;
constexpr int kPatienceForAWriter_s = 3;

[[noreturn]] void cannot_be_read() {
  throw UnreadableFile("cannot be read: " + std::generic_category().message(errno),
                       "does the file exist, and may this user read it?");
}

[[noreturn]] void is_too_large(std::size_t most_bytes) {
  throw UnreadableFile("is larger than " + std::to_string(most_bytes / 1024) + " KiB",
                       "is this the right file?");
}

class OpenFile {
 public:
  // Without waiting: to open a pipe that nobody writes to would take for ever.
  OpenFile(const std::filesystem::path& file, int patience_s)
      : descriptor_(open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY)),
        patience_s_(patience_s) {
    if (descriptor_ < 0 || fstat(descriptor_, &facts_) != 0) cannot_be_read();
  }
  ~OpenFile() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  [[nodiscard]] bool is_directory() const { return S_ISDIR(facts_.st_mode); }
  [[nodiscard]] bool is_larger_than(std::size_t bytes) const {
    return S_ISREG(facts_.st_mode) && facts_.st_size > static_cast<off_t>(bytes);
  }

  /// The next bytes into `chunk`; 0 = the end.
  std::size_t read_into(std::array<char, kChunkBytes>& chunk) {
    while (true) {
      const ssize_t count = read(descriptor_, chunk.data(), chunk.size());
      // A pipe ends at once while nobody has opened it for writing.
      const bool nobody_writes = count == 0 && !written_ && S_ISFIFO(facts_.st_mode);
      if (count >= 0 && !nobody_writes) return static_cast<std::size_t>(count);
      if (count < 0 && errno != EAGAIN && errno != EINTR) cannot_be_read();
      wait(nobody_writes ? std::min(kPatienceForAWriter_s, patience_s_) : patience_s_);
      written_ = true;
    }
  }

 private:
  void wait(int seconds) const {
    pollfd waiting{descriptor_, POLLIN, 0};
    if (poll(&waiting, 1, seconds * 1000) == 0) {
      throw UnreadableFile("is a pipe or a device that gives nothing",
                           "name a file, or start what writes into the pipe first");
    }
  }

  int descriptor_;
  int patience_s_;
  struct stat facts_ {};
  bool written_ = false;  ///< somebody has opened the pipe for writing
};

}  // namespace

std::string read_bounded(const std::filesystem::path& file, std::size_t most_bytes,
                         int patience_s) {
  OpenFile open_file(file, patience_s);
  if (open_file.is_directory()) throw UnreadableFile("is a folder", "name a file in it");
  if (open_file.is_larger_than(most_bytes)) is_too_large(most_bytes);
  std::string text;
  std::array<char, kChunkBytes> chunk{};
  while (const std::size_t count = open_file.read_into(chunk)) {
    const std::string_view part(chunk.data(), count);
    if (part.find('\0') != std::string_view::npos) {
      throw UnreadableFile("is not text: it has zero bytes", "save it as UTF-8");
    }
    text += part;
    if (text.size() > most_bytes) is_too_large(most_bytes);
  }
  return text;
}

}  // namespace loopscope::config
