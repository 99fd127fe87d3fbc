#include "storage/historian/check_historian.hpp"

#include <gmock/gmock.h>

#include "tests/storage/historian/historian_fixture.hpp"

namespace loopscope::storage {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::StartsWith;

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
  std::vector<std::string> said;
  for (const Finding& found : check()) {
    EXPECT_TRUE(found.ok && !found.warning) << found.what;
    EXPECT_EQ(found.hint, "");
    said.push_back(found.what);
  }
  const std::string table = R"("public"."history")";
  EXPECT_THAT(said, ElementsAre(StartsWith("connected to the historian database ("),
                                table + " has the columns and can be read",
                                "an index serves the reading of windows, " + table,
                                "the plan of a window uses indexes only, " + table,
                                MatchesRegex("the newest row is of .*, " + table)));
}

TEST_F(CheckHistorianTest, OldOrFutureRowsAreWarnedOf) {
  EXPECT_THAT(
      check(),
      Contains(AllOf(finding(true, true,
                             "no row is younger than a week, "
                             R"("public"."history")"),
                     Field(&Finding::hint, "check that the historian records, and `time_kind`"))));
  database->execute("INSERT INTO history VALUES ('a', now() + interval '1 hour', 1, 192)");
  EXPECT_THAT(check(), Contains(AllOf(finding(true, true, "the newest row lies in the future, at "),
                                      Field(&Finding::hint,
                                            "check `time_kind`, the time zone of the "
                                            "recorder and its clock"))));
}

TEST_F(CheckHistorianTest, IndexIsJudged) {
  database->execute("DROP INDEX history_tag_time_value_quality_idx");
  const std::vector<Finding> found = check();
  EXPECT_THAT(found, Contains(finding(false, false,
                                      "no index starts with (tag, time), so every window would "
                                      R"(scan the table, "public"."history")")));
  EXPECT_THAT(found, Contains(Field(&Finding::hint,
                                    "CREATE INDEX CONCURRENTLY ON \"public\".\"history\" (\"tag\", "
                                    "\"time\") INCLUDE (\"value\", \"quality\")")));
  database->execute("CREATE INDEX ON history (time, tag); CREATE INDEX ON history (tag)");
  EXPECT_THAT(check(), Contains(finding(false, false, "no index starts with (tag, time)")));
  database->execute("CREATE INDEX ON history (tag, time DESC)");
  EXPECT_THAT(check(), Contains(finding(true, true,
                                        "the index on (tag, time) does not include the value: "
                                        "reading is some three times slower than it could be, "
                                        R"("public"."history")")));
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
  EXPECT_THAT(check(), Contains(AllOf(finding(true, true,
                                              R"("public"."seen" is a view or a foreign table: )"
                                              "its indexes were not checked"),
                                      Field(&Finding::hint,
                                            "make sure that the table behind it has an index "
                                            "on (tag, time)"))));
}

}  // namespace
}  // namespace loopscope::storage
