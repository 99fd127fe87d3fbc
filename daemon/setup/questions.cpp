#include "daemon/setup/questions.hpp"

#include <charconv>
#include <fmt/format.h>
#include <iostream>

#include "daemon/text/failure.hpp"
#include "daemon/text/printable.hpp"

namespace loopscope::daemon {

std::string Questions::text(const std::string& given, const std::string& option,
                            const std::string& question, const std::string& usual) {
  if (!given.empty()) return given;
  if (!answered_) throw Failure(ExitCode::usage, option + " is required", question);
  out_ << question << (usual.empty() ? "" : " [" + usual + "]") << ": " << std::flush;
  const std::string answer = line(option);
  return answer.empty() ? usual : answer;
}

std::size_t Questions::choice(const std::vector<std::string>& lines, const std::string& what,
                              const std::string& hint) {
  for (std::size_t k = 0; k < lines.size(); ++k)
    out_ << fmt::format("  {}. {}\n", k + 1, printable(lines[k]));
  if (!answered_) throw Failure(ExitCode::usage, what, hint);
  while (true) {
    out_ << "Which of them? " << std::flush;
    const std::string answer = line("the answer");
    std::size_t number = 0;
    std::from_chars(answer.data(), answer.data() + answer.size(), number);
    if (number >= 1 && number <= lines.size()) return number - 1;
    out_ << "a number from 1 to " << lines.size() << '\n';
  }
}

std::string Questions::line(const std::string& option) {
  std::string answer;
  if (std::getline(in_, answer)) return answer;
  throw Failure(ExitCode::usage, option + " was not answered", "give it as an option");
}

}  // namespace loopscope::daemon
