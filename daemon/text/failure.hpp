#pragma once

#include <stdexcept>
#include <string>

namespace loopscope::daemon {

/// Exit codes of contract.md.
enum class ExitCode : int {
  done = 0,
  fault = 1,
  usage = 2,
  configuration = 3,
  database = 4,
  unusable_data = 5,
};

/// An error for the user: what() is "what, where", hint() says how to mend it.
class Failure : public std::runtime_error {
 public:
  Failure(ExitCode exit_code, const std::string& what_where, std::string hint)
      : std::runtime_error(what_where), exit_code_(exit_code), hint_(std::move(hint)) {}

  [[nodiscard]] ExitCode exit_code() const { return exit_code_; }
  [[nodiscard]] const std::string& hint() const { return hint_; }

 private:
  ExitCode exit_code_;
  std::string hint_;
};

}  // namespace loopscope::daemon
