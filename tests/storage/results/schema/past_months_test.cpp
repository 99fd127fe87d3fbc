#include "storage/results/schema/past_months.hpp"

#include <gmock/gmock.h>

#include "storage/results/schema/migrate.hpp"
#include "tests/storage/results/results_fixture.hpp"

namespace loopscope::storage {
namespace {

using testing::Contains;
using testing::IsEmpty;
using testing::SizeIs;

class PastMonthsTest : public ResultsTest {
 protected:
  /// Microseconds of an SQL expression.
  [[nodiscard]] std::int64_t time(const std::string& sql) const {
    return std::stoll(value("SELECT (extract(epoch FROM " + sql + ") * 1000000)::bigint"));
  }
  [[nodiscard]] PastMonths months(const std::string& since, int retention_months = 0) const {
    return past_months(settings_for(*database), time(since), retention_months);
  }
};

/// First moment of the month so many months ago.
std::string month_ago(int months) {
  return "(date_trunc('month', now() AT TIME ZONE 'UTC') - interval '" + std::to_string(months) +
         " months') AT TIME ZONE 'UTC'";
}

TEST_F(PastMonthsTest, NamesMonthsWithoutPartitionsUntilMaintainHasMadeThem) {
  const std::string since = month_ago(2) + " + interval '3 days'";
  const std::string first =
      value("SELECT to_char((" + month_ago(2) + ") AT TIME ZONE 'UTC', 'YYYY-MM')");
  EXPECT_THAT(months(since).missing, SizeIs(2));
  EXPECT_EQ(months(since).missing.front(), first);
  const MaintenanceResult made = maintain(settings_for(*database), {.since_us = time(since)});
  EXPECT_THAT(made.created, SizeIs(8));
  EXPECT_THAT(made.created, Contains("verdict_" + first.substr(0, 4) + "_" + first.substr(5)));
  EXPECT_THAT(months(since).missing, IsEmpty());
  const MaintenanceResult again = maintain(settings_for(*database), {.since_us = time(since)});
  EXPECT_THAT(again.created, IsEmpty());
  EXPECT_EQ(again.first_month, first);
  EXPECT_EQ(again.last_month, value("SELECT to_char(now() AT TIME ZONE 'UTC' + interval '3 months',"
                                    " 'YYYY-MM')"));
}

TEST_F(PastMonthsTest, ThisMonthIsThere) {
  EXPECT_THAT(months("now()").missing, IsEmpty());
  EXPECT_THAT(maintain(settings_for(*database), {.since_us = time("now()")}).created, IsEmpty());
}

TEST_F(PastMonthsTest, KnowsWhatTheRetentionKeeps) {
  EXPECT_TRUE(months("timestamptz '1999-01-01'").kept);
  EXPECT_TRUE(months(month_ago(3), 3).kept);
  const PastMonths gone = months(month_ago(3) + " - interval '1 microsecond'", 3);
  EXPECT_FALSE(gone.kept);
  EXPECT_EQ(gone.kept_from,
            value("SELECT to_char((" + month_ago(3) + ") AT TIME ZONE 'UTC', 'YYYY-MM-DD')"));
}

/// What is kept by these words `maintain` does not drop.
TEST_F(PastMonthsTest, MaintainDropsNothingThatIsKept) {
  add_loops({"a"});
  ResultsDatabase results = connect();
  const std::int64_t first = time(month_ago(3));
  maintain(settings_for(*database), {.since_us = first});
  for (const std::int64_t end : {first, time("now()") - 1'000'000}) {
    results.finish(std::vector{completed(claim_all(results).at(0), end, "d")}, {});
    database->execute("UPDATE loopscope.schedule SET visible_at = now()");
  }
  EXPECT_THAT(maintain(settings_for(*database), {.retention_months = 3}).dropped, IsEmpty());
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.analysis"), "2");
}

}  // namespace
}  // namespace loopscope::storage
