#include "storage/historian/setup/historian_survey.hpp"

#include <gmock/gmock.h>

#include "storage/historian/setup/try_login.hpp"
#include "tests/storage/historian/historian_fixture.hpp"

namespace loopscope::storage {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

using HistorianSurveyTest = HistorianTest;

std::vector<std::string> names_of(const std::vector<SeenTable>& tables) {
  std::vector<std::string> names;
  for (const SeenTable& table : tables) names.push_back(table.schema + "." + table.name);
  return names;
}

TEST_F(HistorianSurveyTest, SeesTablesWithoutAnyGrantButNoPartsOfThem) {
  database->execute(
      "CREATE SCHEMA site; CREATE DOMAIN site.reading AS float8;"
      R"(CREATE TABLE site."odd ""name" (at timestamp, v site.reading) PARTITION BY RANGE (at);)"
      R"(CREATE TABLE site.part PARTITION OF site."odd ""name" DEFAULT;)"
      R"(COMMENT ON COLUMN site."odd ""name".at IS 'tag';)"
      "CREATE SCHEMA loopscope; CREATE TABLE loopscope.loop (x int)");
  HistorianSurvey survey(settings(database->make_login("")));
  const std::vector<SeenTable> tables = survey.tables();
  EXPECT_THAT(names_of(tables), ElementsAre("public.history", "site.odd \"name"));
  EXPECT_FALSE(tables.at(1).readable);
  ASSERT_EQ(tables.at(1).columns.size(), 2U);
  EXPECT_EQ(tables.at(1).columns[0].type, "timestamp");
  EXPECT_EQ(tables.at(1).columns[0].comment, "tag");
  EXPECT_EQ(tables.at(1).columns[1].type, "float8");
  EXPECT_TRUE(HistorianSurvey(settings()).tables().at(1).readable);
}

TEST_F(HistorianSurveyTest, CountsWhatStandsInAColumn) {
  database->execute(
      "INSERT INTO history SELECT 'a', now(), 1, CASE WHEN k % 4 = 0 THEN 0 ELSE 192 END"
      " FROM generate_series(1, 100) AS k");
  HistorianSurvey survey(settings());
  EXPECT_THAT(survey.sample(survey.tables().at(0), "quality"),
              ElementsAre(Pair("192", 75), Pair("0", 25)));
}

TEST_F(HistorianSurveyTest, SeesWhereTimesWithoutAZoneLie) {
  database->execute("CREATE TABLE x (at timestamp)");
  HistorianSurvey survey(settings());
  const SeenTable table = survey.tables().at(1);
  EXPECT_EQ(survey.seconds_behind_utc(table, "at"), std::nullopt);
  database->execute("INSERT INTO x VALUES (now() AT TIME ZONE 'UTC' + interval '2 hours')");
  EXPECT_NEAR(survey.seconds_behind_utc(table, "at").value(), -7200.0, 60.0);
}

TEST_F(HistorianSurveyTest, LoginsAreTried) {
  EXPECT_EQ(try_login(settings()).state, LoginTrial::State::works);
  const LoginTrial nobody = try_login(settings("nobody_of_that_name"));
  EXPECT_EQ(nobody.state, LoginTrial::State::refused);
  EXPECT_THAT(nobody.problem, HasSubstr("nobody_of_that_name"));
  ConnectionSettings nowhere = settings();
  nowhere.conninfo = "host=/no/such/folder";
  EXPECT_EQ(try_login(nowhere).state, LoginTrial::State::unreachable);
}

}  // namespace
}  // namespace loopscope::storage
