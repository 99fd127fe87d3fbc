#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "config/read_settings.hpp"

namespace loopscope::config::tests {

/// The shortest valid file, with `members` (JSON members, without braces) added at the top level.
[[nodiscard]] inline std::string minimal_with(const std::string& members = {}) {
  return R"({"results": {"connection": "service=results"},
             "historians": [{"connection": "service=plant"}])" +
         (members.empty() ? members : ", " + members) + "}";
}

/// The problems of a text; empty when it is accepted.
[[nodiscard]] inline std::vector<Problem> problems_of(std::string_view text) {
  try {
    static_cast<void>(parse_settings(text, "test.json"));
    return {};
  } catch (const SettingsError& error) {
    return error.problems();
  }
}

/// "path: message" of each problem.
[[nodiscard]] inline std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  for (const Problem& problem : problems_of(text))
    lines.push_back(problem.path + ": " + problem.message);
  return lines;
}

/// The hint of the first problem; empty when there is none.
[[nodiscard]] inline std::string first_hint_of(std::string_view text) {
  const std::vector<Problem> problems = problems_of(text);
  return problems.empty() ? std::string() : problems.front().hint;
}

/// A valid file that gives every setting of the table its default.
[[nodiscard]] std::string complete_text();

}  // namespace loopscope::config::tests
