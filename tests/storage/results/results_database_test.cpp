#include "storage/results/results_database.hpp"

#include <gmock/gmock.h>
#include <thread>

#include "tests/storage/results/results_fixture.hpp"

namespace loopscope::storage {
namespace {

using testing::HasSubstr;

class ResultsDatabaseTest : public ResultsTest {};

TEST_F(ResultsDatabaseTest, EmptyCallsAreHarmless) {
  ResultsDatabase results = connect();
  const WriteCount count = results.finish({}, {});
  EXPECT_EQ(count.inserted + count.revised + count.unchanged + count.failed + count.fenced_off, 0u);
  results.release({});
  EXPECT_TRUE(results.extend({}, 10).empty());
  EXPECT_TRUE(results.stored_digests({}, 1).empty());
}

TEST_F(ResultsDatabaseTest, StoredDigestsAnswersForThePairsAsked) {
  add_loops({"a", "b"});
  ResultsDatabase results = connect();
  const std::vector<ClaimedLoop> claimed = claim_all(results);
  results.finish(
      std::vector{completed(claimed[0], slot(1), "da"), completed(claimed[1], slot(2), "db")}, {});
  const std::int64_t a = claimed[0].loop.loop_id;
  const std::int64_t b = claimed[1].loop.loop_id;
  const std::vector<std::pair<std::int64_t, std::int64_t>> asked{
      {a, slot(1)}, {a, slot(2)}, {b, slot(2)}};
  const std::vector<StoredDigest> found = results.stored_digests(asked, core::kAlgorithmRevision);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].loop_id, a);
  EXPECT_EQ(found[0].slot_end_us, slot(1));
  EXPECT_EQ(found[0].input_digest, "da");
  EXPECT_EQ(found[1].input_digest, "db");
  EXPECT_TRUE(results.stored_digests(asked, core::kAlgorithmRevision + 1).empty());
}

TEST_F(ResultsDatabaseTest, ParametersAreSetByName) {
  ResultsDatabase results = connect();
  results.set_parameter("min_confidence", 0.625);
  EXPECT_EQ(value("SELECT value FROM loopscope.parameter WHERE name = 'min_confidence'"), "0.625");
  EXPECT_THROW(results.set_parameter("no such", 1.0), DatabaseError);
}

TEST_F(ResultsDatabaseTest, LostConnectionIsSaidOnceAndForAll) {
  add_loops({"a"});
  ResultsDatabase results = connect();
  database->execute(
      "SELECT pg_terminate_backend(pid) FROM pg_stat_activity"
      " WHERE datname = current_database() AND application_name LIKE 'loopscope/%'");
  // The third use would be the one that libpqxx 6.4 silently reconnects for.
  for (int use = 0; use < 5; ++use) {
    try {
      static_cast<void>(results.claim_due("worker", 10, 1));
      FAIL() << "use " << use;
    } catch (const DatabaseError& error) {
      EXPECT_EQ(error.remedy(), Remedy::reconnect) << error.what();
    }
  }
}

TEST_F(ResultsDatabaseTest, LockTimeoutAsksForARetry) {
  add_loops({"a"});
  ConnectionSettings impatient = settings_for(*database);
  impatient.conninfo += " options='-c lock_timeout=100ms'";
  ResultsDatabase results(impatient);
  const ClaimedLoop claim = results.claim_due("worker", 10, 1).at(0);
  ConnectionSettings other = settings_for(*database);
  std::jthread holder([&] {
    database->execute("BEGIN; SELECT * FROM loopscope.schedule FOR UPDATE; SELECT pg_sleep(2)");
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  try {
    results.finish(std::vector{completed(claim, slot(1), "d")}, {});
    FAIL();
  } catch (const DatabaseError& error) {
    EXPECT_EQ(error.remedy(), Remedy::retry) << error.what();
    EXPECT_EQ(error.sqlstate(), "55P03");
    EXPECT_THAT(error.what(), HasSubstr("statement complete"));
  }
}

}  // namespace
}  // namespace loopscope::storage
