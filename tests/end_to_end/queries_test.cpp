#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>

#include "tests/end_to_end/told_plant.hpp"

/// deploy/queries/README.md: every query runs with the rights that it says and has something to
/// show.
namespace loopscope::tests {
namespace {

using testing::IsEmpty;
using testing::Not;

struct Query {
  std::string section, title, purpose, statement;
};

std::vector<Query> ready_queries() {
  std::ifstream file(source_dir() / "deploy" / "queries" / "README.md");
  std::vector<Query> queries;
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

TEST(ReadyQueries, EachRunsWithItsRightsAndHasSomethingToShow) {
  const ToldPlant plant;
  const std::vector<Query> queries = ready_queries();
  EXPECT_GT(queries.size(), 30U);
  std::set<std::string> titles;
  for (const Query& query : queries) {
    SCOPED_TRACE(query.title);
    EXPECT_TRUE(titles.insert(query.title).second);
    EXPECT_THAT(query.purpose, Not(IsEmpty()));
    ASSERT_THAT(query.statement, Not(IsEmpty()));
    const bool writes = query.section.starts_with("To write");
    const ProgramResult shown =
        plant.ask(writes ? "loopscope_engineer" : "loopscope_reader", query.statement);
    EXPECT_EQ(shown.exit_code, 0) << shown.err;
    EXPECT_THAT(shown.out, Not(IsEmpty()));
    if (writes) {
      EXPECT_NE(plant.ask("loopscope_reader", query.statement).exit_code, 0);
    }
  }
}

}  // namespace
}  // namespace loopscope::tests
