#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace loopscope::tests {

/// What a finished program left behind.
struct ProgramResult {
  int exit_code = -1;  ///< -1 when it did not exit by itself
  std::string out;     ///< standard output
  std::string err;     ///< standard error
};

/// Runs `arguments` (the program first, found by path) to its end, standard input closed.
[[nodiscard]] ProgramResult run_program(const std::vector<std::string>& arguments);

/// All bytes of a file; nothing where there is none.
[[nodiscard]] std::string content_of(const std::filesystem::path& file);

/// A program in the background; killed at the end if it still runs.
class BackgroundProgram {
 public:
  /// Standard error goes to `log_file`.
  BackgroundProgram(const std::vector<std::string>& arguments, const std::string& log_file);
  ~BackgroundProgram();
  BackgroundProgram(const BackgroundProgram&) = delete;
  BackgroundProgram& operator=(const BackgroundProgram&) = delete;

  void send(int signal) const;
  /// Exit code; -1 when it does not exit within `seconds`.
  [[nodiscard]] int wait(double seconds);

 private:
  int pid_ = -1;
};

}  // namespace loopscope::tests
