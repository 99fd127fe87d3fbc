#include <chrono>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "tests/end_to_end/plant.hpp"

/// Windows of the past, judged from what the historian holds of them.
namespace loopscope::tests {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

/// A window's worth and two slots of six hours, of samples of 10 s.
constexpr const char* kSettings = R"("schedule": {"settle_s": 0, "default_period_s": 21600})";
/// Times and numbers that differ from run to run.
constexpr const char* kOwnOf =
    " - '{analysis_id,analysed_at,decided_at,fence,fetch_ms,analyse_ms,"
    "prepare_ms,statistics_ms,model_ms}'::text[]";
constexpr const char* kTables[] = {"analysis", "verdict", "bicoherence_peak", "explanation_step"};

class Backfill : public testing::Test {
 protected:
  Backfill() {
    wait_for_hour_with(std::chrono::seconds(60));
    plant.write_settings(Plant::settings(kSettings));
    plant.import_simulated("FIC101", "sticking_valve", "1");
    plant.import_simulated("TIC102", "deadband", "2");
    // Recorded at 1 s: the same samples 10 s apart, up to the end of a slot.
    plant.sql(
        "WITH newest AS (SELECT max(time) AS time FROM history) UPDATE history SET time ="
        " date_bin('6 hours', now(), 'epoch')"
        " - 10 * (newest.time - history.time) FROM newest");
    plant.sql("UPDATE loopscope.loop SET period_s = 21600");
    last = plant.sql("SELECT max(time) FROM history");
  }
  [[nodiscard]] std::string at(int hours_before) const {
    return "timestamptz '" + last + "' - interval '" + std::to_string(hours_before) + " hours'";
  }
  [[nodiscard]] std::string iso(int hours_before) const {
    return plant.sql("SELECT to_char((" + at(hours_before) +
                     ") AT TIME ZONE 'UTC', 'YYYY-MM-DD\"T\"HH24:MI:SS\"Z\"')");
  }
  [[nodiscard]] ProgramResult backfill(int hours_before, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"--since", iso(hours_before), "--every", "6h"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return plant.loopscope("backfill", arguments);
  }
  /// In case a month has begun within the hours that these tests look back.
  void make_months() const {
    ASSERT_EQ(plant.loopscope("maintain", {"--since", iso(24)}).exit_code, 0);
  }
  [[nodiscard]] static std::string settings_that_keep_all() {
    std::string text = Plant::settings(kSettings);
    const std::string connection = R"("connection": "@RESULTS@")";
    return text.replace(text.find(connection), connection.size(),
                        connection + R"(, "retention_months": 0)");
  }
  /// `once` at each of these times, in their order, as if the rows behind it had not been written.
  void once_at(const std::vector<int>& hours_before) const {
    plant.sql("ALTER TABLE history RENAME TO whole");
    for (const int hours : hours_before) {
      plant.sql("CREATE TABLE history AS SELECT * FROM whole WHERE time <= " + at(hours));
      EXPECT_EQ(plant.loopscope("once").exit_code, 0);
      plant.sql("DROP TABLE history");
    }
    plant.sql("ALTER TABLE whole RENAME TO history");
  }
  void keep_and_forget_results() const {
    for (const std::string table : kTables)
      plant.sql("CREATE TABLE kept_" + table + " AS SELECT * FROM loopscope." + table +
                "; TRUNCATE loopscope." + table);
    plant.sql(
        "TRUNCATE loopscope.flag_notice, loopscope.standing_problem; UPDATE"
        " loopscope.schedule SET visible_at = now(), last_slot_end = NULL, result_slot_end ="
        " NULL, pv_flat_s = NULL, pv_step = NULL");
  }
  [[nodiscard]] std::string differences(const std::string& table) const {
    const std::string kept =
        "SELECT to_jsonb(k)" + std::string(kOwnOf) + " FROM kept_" + table + " AS k";
    const std::string made =
        "SELECT to_jsonb(m)" + std::string(kOwnOf) + " FROM loopscope." + table + " AS m";
    return plant.sql("SELECT count(*) FROM ((" + kept + " EXCEPT " + made + ") UNION ALL (" + made +
                     " EXCEPT " + kept + ")) AS different");
  }
  Plant plant;
  std::string last;  ///< the newest row's time
};

TEST_F(Backfill, WritesTheRowsThatOnceWouldHaveWritten) {
  make_months();
  once_at({6, 0});
  keep_and_forget_results();
  const ProgramResult result = backfill(6);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("4 of 4 windows: 4 judged, 0 had been judged before"));
  EXPECT_EQ(plant.sql("SELECT count(*) FROM kept_analysis"), "4");
  for (const std::string table : kTables) EXPECT_EQ(differences(table), "0") << table;
  EXPECT_EQ(plant.sql("SELECT count(*) FROM loopscope.flag_notice"), "0");
  EXPECT_EQ(plant.sql("SELECT count(*) FROM loopscope.standing_problem"), "0");
  EXPECT_EQ(plant.sql("SELECT count(last_slot_end), count(owner) FROM loopscope.schedule"), "0|0");
}

TEST_F(Backfill, GoesOnWithWhatIsLeftAndTellsWhatIsNotRecorded) {
  make_months();
  EXPECT_THAT(backfill(0, {"--loop", "FIC101"}).out,
              AllOf(HasSubstr("1 loop, 1 window each, from " + iso(0)),
                    HasSubstr("1 of 1 window: 1 judged")));
  // FIC101 was recorded for less than twelve hours, TIC102 for longer.
  EXPECT_THAT(
      backfill(18).out,
      HasSubstr("8 of 8 windows: 6 judged, 1 had been judged before, 1 without a sample of pv"
                " (before the tag's first row, in a gap or after its last)\n"));
  EXPECT_EQ(plant.sql("SELECT count(*) FROM loopscope.analysis"), "7");
}

/// A mistake of the settings or the catalogue is found when the past has been judged.
TEST_F(Backfill, JudgesAgainWhatHasChanged) {
  make_months();
  EXPECT_EQ(backfill(6).exit_code, 0);
  EXPECT_THAT(backfill(6, {"--again"}).out,
              HasSubstr("4 of 4 windows: 0 judged for the first time, 0 again, since rows, "
                        "catalogue or settings have changed, 4 as they were"));
  EXPECT_EQ(plant.loopscope("loops", {"set", "FIC101", "--op-low=0", "--op-high=120"}).exit_code,
            0);
  EXPECT_THAT(backfill(6).out, HasSubstr("4 had been judged before"));
  EXPECT_THAT(backfill(6, {"--again"}).out,
              HasSubstr("0 judged for the first time, 2 again, since rows, catalogue"));
  EXPECT_EQ(plant.sql("SELECT count(*), count(*) FILTER (WHERE input_revision = 2) FROM"
                      " loopscope.analysis"),
            "4|2");
  EXPECT_EQ(plant.sql("SELECT count(*) FROM loopscope.flag_notice"), "0");
}

/// Work that was done before the program was there.
TEST_F(Backfill, EarlierWorkIsJudged) {
  make_months();
  EXPECT_EQ(plant.loopscope("once").exit_code, 0);
  EXPECT_EQ(plant
                .loopscope("maintenance", {"add", "--loop", "FIC101", "--at", iso(3), "--kind",
                                           "valve", "new packing"})
                .exit_code,
            0);
  EXPECT_EQ(plant.loopscope("once").exit_code, 0);
  const std::string judged = "SELECT judged_at, windows_before FROM loopscope.repair_judgement";
  const std::string before = plant.sql(judged);
  EXPECT_THAT(before, HasSubstr("|0"));
  EXPECT_EQ(backfill(6).exit_code, 0);
  EXPECT_NE(plant.sql(judged), before);
}

/// Loops that were not recorded then write no row by which they could be told from one that fails.
TEST_F(Backfill, ALoopThatFailsIsLeftAloneAndHoldsUpNoOther) {
  plant.write_settings(
      Plant::settings(R"("schedule": {"settle_s": 0, "default_period_s": 21600, "poll_s": 0.1})"));
  make_months();
  EXPECT_EQ(plant.loopscope("loops", {"add", "LOST", "--pv-tag", "LOST.PV"}).exit_code, 0);
  plant.sql("UPDATE loopscope.loop SET source = 'nowhere' WHERE name = 'LOST'");
  const ProgramResult result = backfill(18);
  EXPECT_EQ(result.exit_code, 3) << result.err;
  EXPECT_THAT(result.out,
              HasSubstr("8 of 12 windows: 7 judged, 0 had been judged before, 1 without"));
  EXPECT_THAT(result.err, AllOf(HasSubstr("error: 1 loop was left, the first \"LOST\""),
                                HasSubstr("the same command goes on with what is left")));
  EXPECT_EQ(plant.sql("SELECT count(*) FROM loopscope.schedule WHERE attempts > 0"), "0");
}

/// It is not waited for: nobody enables it again because of this.
TEST_F(Backfill, ALoopThatIsDisabledMeanwhileIsLeftAlone) {
  make_months();
  plant.sql(
      "CREATE FUNCTION public.disable() RETURNS trigger SECURITY DEFINER LANGUAGE plpgsql AS $$ "
      "BEGIN"
      " UPDATE loopscope.loop SET enabled = false WHERE name = 'TIC102'; RETURN NULL; END $$;"
      "CREATE TRIGGER disable AFTER INSERT ON loopscope.analysis FOR EACH ROW"
      " EXECUTE FUNCTION public.disable()");
  const ProgramResult result = backfill(6);
  EXPECT_EQ(result.exit_code, 4) << result.err;
  EXPECT_THAT(result.err, HasSubstr("1 loop was left, the first \"TIC102\": disabled meanwhile"));
}

TEST_F(Backfill, MistakesAreExplained) {
  const auto expect = [&](const std::vector<std::string>& arguments, int code,
                          const std::string& what, const std::string& hint) {
    const ProgramResult result = plant.loopscope("backfill", arguments);
    EXPECT_EQ(result.exit_code, code);
    EXPECT_THAT(result.err, AllOf(HasSubstr("error: " + what), HasSubstr("HINT: " + hint)));
    EXPECT_THAT(result.err, Not(ContainsRegex("[0-9]\\.[0-9]"))) << "whole seconds are enough";
  };
  expect({"--since", "yesterday", "--every", "1d"}, 2, "--since \"yesterday\" is not a time",
         "write ISO 8601");
  expect({"--since", "2999-01-01", "--every", "1d"}, 2, "--since 2999-01-01T00:00:00Z lies after",
         "backfill judges the past");
  expect({"--since", "2020-01-01", "--every", "1 month"}, 2, "\"1 month\" is not a time span",
         "a number and s, min");
  expect({"--since", "2020-01-01", "--every", "1d"}, 2, "2020-01-01T00:00:00Z lies before 20",
         "a later --since, or a larger /results/retention_months");
  plant.write_settings(settings_that_keep_all());
  expect({"--since", "2020-01-01", "--every", "1d"}, 4,
         "the results have no partitions for 2020-01",
         "as the owner: loopscope maintain --config F --since 2020-01-01");
  expect({"--since", iso(6), "--every", "1d", "--loop", "FIC110"}, 2, "no loop named \"FIC110\"",
         "did you mean \"FIC101\"?");
  EXPECT_EQ(plant.loopscope("loops", {"disable", "FIC101"}).exit_code, 0);
  expect({"--since", iso(6), "--every", "1d", "--loop", "FIC101"}, 2,
         "the loop \"FIC101\" is disabled", "loopscope loops --config F enable FIC101");
}

}  // namespace
}  // namespace loopscope::tests
