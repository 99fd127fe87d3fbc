#pragma once

#include <string>
#include <vector>

namespace loopscope::tests {

/// A query of deploy/queries/QUERIES.md.
struct ReadyQuery {
  std::string section, title, purpose, statement;
  /// Whether it wants the rights of an engineer.
  [[nodiscard]] bool writes() const { return section.starts_with("To write"); }
};

[[nodiscard]] std::vector<ReadyQuery> ready_queries();

}  // namespace loopscope::tests
