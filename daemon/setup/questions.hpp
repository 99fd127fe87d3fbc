#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace loopscope::daemon {

/// Asks somebody at a terminal for what no option said. Without one the option is required.
class Questions {
 public:
  /// Both have to outlive this. `answered`: somebody is there to answer.
  Questions(std::istream& in, std::ostream& out, bool answered)
      : in_(in), out_(out), answered_(answered) {}

  /// `given` where it is not empty, else an answer; an empty one stands for `usual`, shown in
  /// brackets. Throws Failure (usage) with option and question where nobody answers.
  [[nodiscard]] std::string text(const std::string& given, const std::string& option,
                                 const std::string& question, const std::string& usual);
  /// Number of one of `lines`, from 0. Throws Failure (usage) with the lines, `what` and `hint`
  /// where nobody answers.
  [[nodiscard]] std::size_t choice(const std::vector<std::string>& lines, const std::string& what,
                                   const std::string& hint);

 private:
  [[nodiscard]] std::string line(const std::string& option);

  std::istream& in_;
  std::ostream& out_;
  bool answered_;
};

}  // namespace loopscope::daemon
