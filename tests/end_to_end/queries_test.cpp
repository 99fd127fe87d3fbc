#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>

#include "tests/end_to_end/ready_queries.hpp"
#include "tests/end_to_end/told_plant.hpp"

/// deploy/queries/QUERIES.md: every query runs with the rights that it says and has something to
/// show.
namespace loopscope::tests {
namespace {

using testing::IsEmpty;
using testing::Not;

TEST(ReadyQueries, EachRunsWithItsRightsAndHasSomethingToShow) {
  const ToldPlant plant;
  const std::vector<ReadyQuery> queries = ready_queries();
  EXPECT_GT(queries.size(), 30U);
  std::set<std::string> titles;
  for (const ReadyQuery& query : queries) {
    SCOPED_TRACE(query.title);
    EXPECT_TRUE(titles.insert(query.title).second);
    EXPECT_THAT(query.purpose, Not(IsEmpty()));
    ASSERT_THAT(query.statement, Not(IsEmpty()));
    const bool writes = query.writes();
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
