#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "daemon/output/descriptor.hpp"
#include "daemon/output/partial_file.hpp"

namespace loopscope::daemon {

/// A file that is written piece by piece, links of this user's and root's followed (follow()).
///
/// A regular file or one that does not exist yet is written whole or not at all (PartialFile); a
/// file that was there keeps its permissions. Anything else (device, pipe, /dev/stdout) is never
/// replaced but written to directly. Every function throws Failure (usage) naming the file and the
/// system's reason when it cannot do its work.
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path file);

  /// Keeps 64 kB at most in memory.
  void write(std::string_view text);
  /// Writes what is left and puts the file into its place; without it a file stays as it was.
  void finish();

 private:
  void open();
  void flush();
  /// Carries `work` out; what the system refuses is said with the file's name.
  template <typename Work>
  void attempt(Work&& work);

  std::filesystem::path file_;          ///< as the caller calls it
  std::optional<PartialFile> partial_;  ///< what is written where a file is replaced
  Descriptor in_place_;                 ///< what is written elsewhere
  std::string pending_;                 ///< not written yet
};

/// Writes `content` to `file` whole or not at all, as OutputFile does. Throws as it does.
void write_file(const std::filesystem::path& file, const std::string& content);

}  // namespace loopscope::daemon
