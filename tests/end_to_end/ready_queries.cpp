#include "tests/end_to_end/ready_queries.hpp"

#include <fstream>

#include "tests/support/source_dir.hpp"

namespace loopscope::tests {

std::vector<ReadyQuery> ready_queries() {
  std::ifstream file(source_dir() / "deploy" / "queries" / "QUERIES.md");
  std::vector<ReadyQuery> queries;
  std::string section;
  bool in_statement = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("```")) {
      in_statement = line == "```sql";
    } else if (in_statement) {
      queries.back().statement += line + "\n";
    } else if (line.starts_with("## ")) {
      section = line.substr(3);
    } else if (line.starts_with("### ")) {
      queries.push_back({section, line.substr(4), "", ""});
    } else if (!line.empty() && !queries.empty() && queries.back().statement.empty()) {
      queries.back().purpose += line;
    }
  }
  return queries;
}

}  // namespace loopscope::tests
