#include <algorithm>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/end_to_end/told_plant.hpp"

namespace loopscope::tests {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class Export : public testing::Test {
 protected:
  [[nodiscard]] ProgramResult write(const std::vector<std::string>& rest) const {
    return plant_.plant().loopscope("export", rest);
  }
  void expect_error(const std::vector<std::string>& rest, int exit_code, const std::string& words,
                    const std::string& hint) const {
    const ProgramResult result = write(rest);
    EXPECT_EQ(result.exit_code, exit_code) << words;
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.err, HasSubstr(words));
    EXPECT_THAT(result.err, HasSubstr("HINT: " + hint));
  }
  ToldPlant plant_;
};

TEST_F(Export, CsvForASpreadsheet) {
  const ProgramResult list = write({"flagged_loop"});
  EXPECT_EQ(list.exit_code, 0) << list.err;
  EXPECT_THAT(list.out, StartsWith("rank,loop_id,loop_name,"));
  EXPECT_THAT(list.out, HasSubstr("\n1,"));
  EXPECT_THAT(list.out, HasSubstr("FIC101,plant,flow,valve_stiction,0.675,0.75,1,1,0.9,"));
  EXPECT_THAT(list.out, HasSubstr("\"first; second, with a comma\",Go and look."));
  EXPECT_EQ(std::ranges::count(list.out, '\n'), 4);
}

TEST_F(Export, JsonForAScript) {
  const ProgramResult rows = write({"loop_history", "--format", "json", "--loop", "FIC101"});
  EXPECT_EQ(rows.exit_code, 0) << rows.err;
  const auto list = nlohmann::json::parse(rows.out);
  ASSERT_EQ(list.size(), 120U);
  EXPECT_EQ(list[0]["loop_name"], "FIC101");
  EXPECT_EQ(list[0]["is_current"], true);
  EXPECT_EQ(write({"hidden_loop", "--format", "json", "--since", "2199-01-01"}).out, "[]\n");
}

TEST_F(Export, SinceATime) {
  const std::string a_week_ago = plant_.plant().sql(
      "SELECT to_char(now() - interval '7 days', 'YYYY-MM-DD\"T\"HH24:MI:SS\"Z\"')");
  const ProgramResult rows =
      write({"loop_history", "--loop", "FIC101", "--since", a_week_ago, "--format", "json"});
  EXPECT_NEAR(static_cast<double>(nlohmann::json::parse(rows.out).size()), 14.0, 1.0);
  // Asked for by the clock of the plant, answered in UTC.
  const std::string by_its_clock =
      plant_.plant().sql("SELECT timestamptz '" + a_week_ago + "' AT TIME ZONE 'Asia/Kolkata'");
  plant_.plant().write_settings(Plant::settings(R"("plant": {"time_zone": "Asia/Kolkata"})"));
  EXPECT_EQ(
      write({"loop_history", "--loop", "FIC101", "--since", by_its_clock, "--format", "json"}).out,
      rows.out);
}

TEST_F(Export, AFileIsWholeOrNotThere) {
  const std::string file = plant_.plant().folder() / "history.csv";
  EXPECT_EQ(write({"loop_history", "--out", file}).exit_code, 0);
  EXPECT_EQ(content_of(file), write({"loop_history"}).out);
  expect_error({"loop_history", "--out", "/nonexistent/x.csv"}, 2, "cannot write", "name a file");
  // A statement that fails when the file is open already.
  const std::string later = plant_.plant().folder() / "broken.csv";
  plant_.plant().sql(
      "CREATE OR REPLACE VIEW loopscope.verdict_kind AS SELECT code, is_fault,"
      " 1.0 / (weight - weight) AS weight, meaning FROM (SELECT 'healthy' AS code,"
      " false AS is_fault, 1.0::float8 AS weight, 'x' AS meaning) AS one");
  EXPECT_EQ(write({"verdict_kind", "--out", later}).exit_code, 4);
  EXPECT_FALSE(std::filesystem::exists(later));
  for (const auto& entry : std::filesystem::directory_iterator(plant_.plant().folder()))
    EXPECT_EQ(entry.path().string().find("partial"), std::string::npos) << entry.path();
}

TEST_F(Export, NamesThatASpreadsheetTakesForFormulasAreQuoted) {
  plant_.plant().sql("UPDATE loopscope.loop SET name = '=cmd()' WHERE name = 'NEW1'");
  const ProgramResult list = write({"flagged_loop"});
  EXPECT_THAT(list.out, HasSubstr(",'=cmd(),"));
  EXPECT_THAT(list.err, HasSubstr("note: 1 cell begins with"));
  EXPECT_THAT(write({"flagged_loop", "--format", "json"}).out, HasSubstr("\"=cmd()\""));
}

TEST_F(Export, ErrorsSayTheWayOut) {
  expect_error({"flaged_loop"}, 2, "no view named \"flaged_loop\"", "did you mean flagged_loop?");
  expect_error({"loop"}, 2, "no view named", "loopscope export --help");
  expect_error({"verdict_kind", "--loop", "FIC101"}, 2, "is not about loops", "leave it out");
  expect_error({"verdict_kind", "--since", "2026-01-01"}, 2, "has no time", "leave it out");
  expect_error({"flagged_loop", "--since", "x"}, 2, "is not a time", "write ISO 8601");
  expect_error({"flagged_loop", "--loop", "FIC11"}, 2, "no loop named", "did you mean \"FIC101\"?");
  expect_error({"flagged_loop", "--format", "xml"}, 2, "--format", "see loopscope");
  expect_error({}, 2, "VIEW is required", "see loopscope");
}

}  // namespace
}  // namespace loopscope::tests
