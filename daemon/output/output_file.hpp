#pragma once

#include <filesystem>
#include <fstream>
#include <string_view>

namespace loopscope::daemon {

/// A file that is written piece by piece, links followed.
///
/// A regular file or one that does not exist yet is written whole or not at all: under another
/// name in the same folder first, then renamed; a file that was there keeps its permissions.
/// Anything else (device, pipe) is never replaced but written to directly. Every function throws
/// Failure (usage) naming the file and the system's reason when it cannot do its work.
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& file);
  /// Without finish() nothing is left behind.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view text);
  void finish();

 private:
  void require_good();

  std::filesystem::path file_;     ///< as the caller calls it
  std::filesystem::path target_;   ///< what is replaced; empty = nothing is
  std::filesystem::path written_;  ///< what is open
  std::ofstream stream_;
};

}  // namespace loopscope::daemon
