#include "storage/historian/check_historian.hpp"

#include <gmock/gmock.h>

#include "tests/storage/historian/historian_fixture.hpp"

namespace loopscope::storage {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Field;
using testing::HasSubstr;

class CheckHistorianTest : public HistorianTest {
 protected:
  std::vector<Finding> check() { return check_historian(settings(), layout); }
};

auto finding(bool ok, bool warning, const std::string& words) {
  return AllOf(Field(&Finding::ok, ok), Field(&Finding::warning, warning),
               Field(&Finding::what, HasSubstr(words)));
}

TEST_F(CheckHistorianTest, GoodTableWithFreshRowsIsAllRight) {
  database->execute("INSERT INTO history VALUES ('a', now() - interval '1 minute', 1, 192)");
  for (const Finding& found : check()) {
    EXPECT_TRUE(found.ok && !found.warning) << found.what;
    EXPECT_EQ(found.hint, "");
  }
}

TEST_F(CheckHistorianTest, OldOrFutureRowsAreWarnedOf) {
  EXPECT_THAT(check(), Contains(finding(true, true, "no row is younger than a week")));
  database->execute("INSERT INTO history VALUES ('a', now() + interval '1 hour', 1, 192)");
  EXPECT_THAT(check(), Contains(finding(true, true, "lies in the future")));
}

TEST_F(CheckHistorianTest, IndexIsJudged) {
  database->execute("DROP INDEX history_tag_time_value_quality_idx");
  const std::vector<Finding> found = check();
  EXPECT_THAT(found, Contains(finding(false, false, "no index starts with (tag, time)")));
  EXPECT_THAT(found, Contains(Field(&Finding::hint,
                                    "CREATE INDEX CONCURRENTLY ON \"public\".\"history\" (\"tag\", "
                                    "\"time\") INCLUDE (\"value\", \"quality\")")));
  database->execute("CREATE INDEX ON history (time, tag); CREATE INDEX ON history (tag)");
  EXPECT_THAT(check(), Contains(finding(false, false, "no index starts with (tag, time)")));
  database->execute("CREATE INDEX ON history (tag, time DESC)");
  EXPECT_THAT(check(), Contains(finding(true, true, "does not include the value")));
}

TEST_F(CheckHistorianTest, HintIsSqlThatWorks) {
  database->execute("DROP INDEX history_tag_time_value_quality_idx");
  for (const Finding& found : check()) {
    if (!found.ok) database->execute(found.hint);
  }
  EXPECT_THAT(check(), Contains(finding(true, false, "an index serves")));
}

TEST_F(CheckHistorianTest, ProblemsAreFindingsNotExceptions) {
  layout.relation = "public.nothing";
  EXPECT_THAT(check(), Contains(finding(false, false, "no such table")));
  ConnectionSettings nowhere = settings();
  nowhere.conninfo = "host=/no/such/folder";
  EXPECT_THAT(check_historian(nowhere, layout), Contains(finding(false, false, "/no/such")));
  nowhere.conninfo = "nonsense";
  EXPECT_THAT(check_historian(nowhere, layout), Contains(finding(false, false, "cannot be read")));
}

TEST_F(CheckHistorianTest, ViewIsReadButItsIndexCannotBeSeen) {
  database->execute("CREATE VIEW seen AS SELECT * FROM history");
  layout.relation = "public.seen";
  EXPECT_THAT(check(), Contains(finding(true, true, "is a view")));
}

}  // namespace
}  // namespace loopscope::storage
