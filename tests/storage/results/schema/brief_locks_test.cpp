#include "storage/results/schema/brief_locks.hpp"

#include <algorithm>
#include <future>
#include <gmock/gmock.h>
#include <pqxx/pqxx>

#include "storage/results/schema/migrate.hpp"
#include "tests/storage/results/results_fixture.hpp"

namespace loopscope::storage {
namespace {

using Clock = std::chrono::steady_clock;

class BriefLocks : public ResultsTest {
 protected:
  /// The longest that asking for the verdicts has taken, asked again and again for `span`, s.
  [[nodiscard]] double longest_reading(std::chrono::seconds span) const {
    std::chrono::duration<double> longest{0.0};
    for (const auto begin = Clock::now(); Clock::now() < begin + span;) {
      const auto asked = Clock::now();
      static_cast<void>(value("SELECT count(*) FROM loopscope.verdict"));
      longest = std::max<std::chrono::duration<double>>(longest, Clock::now() - asked);
      std::this_thread::sleep_for(std::chrono::milliseconds{20});
    }
    return longest.count();
  }
};

/// A dump, a long query. Whoever waits for a lock lets everybody wait who comes after.
TEST_F(BriefLocks, AReaderInTheWayIsOutwaitedAndTheOthersReadOn) {
  constexpr std::chrono::seconds kLongerThanAnyConnectionWaits{6};
  database->execute("SELECT loopscope.make_partitions('2020-02-15', 1)");
  pqxx::connection connection(database->conninfo());
  pqxx::work reader(connection);
  reader.exec("SELECT count(*) FROM loopscope.verdict");
  auto maintained = std::async(std::launch::async, [this] {
    return maintain(settings_for(*database), {.retention_months = 24});
  });
  EXPECT_LT(longest_reading(kLongerThanAnyConnectionWaits), 3.0) << "another reader waited, s";
  reader.abort();
  EXPECT_EQ(maintained.get().dropped.size(), 4U);
}

TEST_F(BriefLocks, AnotherErrorIsNotTriedAgain) {
  Session session(settings_for(*database));
  int tries = 0;
  const auto fail = [&](Transaction& transaction) {
    ++tries;
    transaction.run({"wrong", "SELECT 1 / 0"});
  };
  EXPECT_THROW(transact_between_others(session, fail), DatabaseError);
  EXPECT_EQ(tries, 1);
}

}  // namespace
}  // namespace loopscope::storage
