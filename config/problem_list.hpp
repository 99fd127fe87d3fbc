#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "config/problem.hpp"

namespace loopscope::config {

/// Collects the problems of one file and keeps one mistake from being reported twice: a value that
/// was refused stands at its default, and no other rule may judge that default.
class ProblemList {
 public:
  void add(Problem problem);

  /// Adds a problem that was drawn from the values at `paths` (the first of them names it), unless
  /// one of these values was refused already.
  void add_unless_refused(const std::vector<std::string>& paths, const std::string& message,
                          const std::string& hint);

  [[nodiscard]] const std::vector<Problem>& problems() const { return problems_; }

 private:
  /// Whether the value at `path`, or an object that would hold it, has a problem.
  [[nodiscard]] bool refused(std::string_view path) const;

  std::vector<Problem> problems_;
};

}  // namespace loopscope::config
