#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "config/analysis_settings_json.hpp"
#include "config/describe_settings.hpp"
#include "config/problem.hpp"
#include "config/settings.hpp"

namespace loopscope::config {

/// Thrown with every problem of the file at once; what() lists them one a line, without the hints:
/// "FILE: /schedule/poll_s: 0.01 is out of range, 0.1 to 3600 s".
class SettingsError : public std::runtime_error {
 public:
  SettingsError(const std::string& file, std::vector<Problem> problems);
  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::string file_;
  std::vector<Problem> problems_;
};

/// Reads and validates a settings file: JSON with // and /* */ comments, at most 256 KiB. Throws
/// SettingsError with every problem: syntax, unknown key (with the nearest known one), repeated
/// key, wrong type, range, cross rules. A problem of the file as a whole has an empty path.
[[nodiscard]] Settings read_settings(const std::filesystem::path& file);

/// The same from text; `name` stands for the file in messages.
[[nodiscard]] Settings parse_settings(std::string_view text, const std::string& name);

}  // namespace loopscope::config
