#include <gmock/gmock.h>

#include "tests/storage/results/results_fixture.hpp"

namespace loopscope::storage {
namespace {

using testing::SizeIs;

/// Somebody of the owner's who has changed something and forgotten to commit.
class OpenTransactionTest : public ResultsTest {
 protected:
  void SetUp() override {
    ResultsTest::SetUp();
    if (!database) return;
    add_loops({"a", "b"});
    forgotten.emplace(database->conninfo());
  }
  std::optional<tests::SqlConnection> forgotten;
};

TEST_F(OpenTransactionTest, OnOtherColumnsOfTheCatalogueStopsNoClaim) {
  forgotten->run("BEGIN; UPDATE loopscope.loop SET importance = 2");
  ResultsDatabase results = connect();
  const std::vector<ClaimedLoop> claimed = claim_all(results);
  ASSERT_THAT(claimed, SizeIs(2));
  EXPECT_EQ(results.finish(std::vector{completed(claimed[0], slot(1), "d")}, {}).inserted, 1U);
}

TEST_F(OpenTransactionTest, StopsTheClaimsOfThoseLoopsAloneThatItSwitches) {
  forgotten->run("BEGIN; UPDATE loopscope.loop SET enabled = name <> 'a'");
  ResultsDatabase results = connect();
  const std::vector<ClaimedLoop> claimed = claim_all(results);
  ASSERT_THAT(claimed, SizeIs(1));
  EXPECT_EQ(claimed[0].loop.name, "b");
  forgotten->run("COMMIT");
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.schedule WHERE enabled"), "1");
}

TEST_F(OpenTransactionTest, OnAParameterStopsNobodyWhoSetsWhatStands) {
  ResultsDatabase results = connect();
  results.set_parameter("min_confidence", 0.25);
  forgotten->run("BEGIN; SELECT FROM loopscope.parameter WHERE name = 'min_confidence' FOR UPDATE");
  EXPECT_NO_THROW(results.set_parameter("min_confidence", 0.25));
  EXPECT_THROW(results.set_parameter("min_confidence", 0.5), DatabaseError) << "it is locked";
  forgotten->run("COMMIT");
  results.set_parameter("min_confidence", 0.5);
  EXPECT_EQ(value("SELECT value FROM loopscope.parameter WHERE name = 'min_confidence'"), "0.5");
}

}  // namespace
}  // namespace loopscope::storage
