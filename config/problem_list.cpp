#include "config/problem_list.hpp"

#include <algorithm>
#include <utility>

namespace loopscope::config {

namespace {

bool holds(std::string_view container, std::string_view path) {
  return path.starts_with(container) &&
         (path.size() == container.size() || path[container.size()] == '/');
}

}  // namespace

void ProblemList::add(Problem problem) {
  problems_.push_back(std::move(problem));
}

void ProblemList::add_unless_refused(const std::vector<std::string>& paths,
                                     const std::string& message, const std::string& hint) {
  if (std::none_of(paths.begin(), paths.end(), [this](const auto& path) { return refused(path); }))
    add({*paths.begin(), message, hint});
}

bool ProblemList::refused(std::string_view path) const {
  return std::any_of(problems_.begin(), problems_.end(),
                     [path](const Problem& problem) { return holds(problem.path, path); });
}

}  // namespace loopscope::config
