#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/end_to_end/plant.hpp"

namespace loopscope::tests {
namespace {

using testing::HasSubstr;

void expect_error(const ProgramResult& result, int exit_code, const std::string& part) {
  EXPECT_EQ(result.exit_code, exit_code) << result.err;
  EXPECT_THAT(result.err, HasSubstr("error: "));
  EXPECT_THAT(result.err, HasSubstr("HINT: "));
  EXPECT_THAT(result.err, HasSubstr(part));
}

class BadInput : public testing::Test {
 protected:
  void expect_nothing_stored() const {
    EXPECT_EQ(plant_.sql("select count(*) from loopscope.analysis"), "0");
  }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(plant_.folder() / name) << text;
    return plant_.folder() / name;
  }

  Plant plant_;
};

TEST_F(BadInput, SettingsProblemsAreNamedAllAtOnce) {
  plant_.write_settings(Plant::settings(
      R"("schedule": {"poll_seconds": 5, "settle_s": -1}, "analysis": {"hos": {"alpha": 2}})"));
  const ProgramResult result = plant_.loopscope("once");
  expect_error(result, 3, "/schedule/poll_seconds");
  EXPECT_THAT(result.err, HasSubstr("/schedule/settle_s"));
  EXPECT_THAT(result.err, HasSubstr("/analysis/hos/alpha"));
  plant_.write_settings("{ not json");
  expect_error(plant_.loopscope("check-config"), 3, "line 1");
  expect_nothing_stored();
}

TEST_F(BadInput, TheHttpAddressIsCheckedForItsFormAndForWhoReachesIt) {
  const auto check = [this](const std::string& address) {
    plant_.write_settings(Plant::settings(R"("daemon": {"http_address": ")" + address + "\"}"));
    return plant_.loopscope("check-config");
  };
  expect_error(check("localhost:9470"), 3, "/daemon/http_address");
  const ProgramResult open = check("0.0.0.0:9470");
  EXPECT_THAT(open.out, HasSubstr("warning  HTTP: 0.0.0.0:9470"));
  EXPECT_THAT(open.out, HasSubstr("anyone who reaches it can read"));
  EXPECT_THAT(check("[::1]:9470").out, HasSubstr("ok       HTTP: [::1]:9470"));
  EXPECT_THAT(check("").out, HasSubstr("ok       HTTP: none"));
}

TEST_F(BadInput, AMissingSettingsFile) {
  expect_error(run_program({LOOPSCOPE_PROGRAM, "once", "--config", "/nowhere/x.json"}), 3,
               "/nowhere/x.json");
}

TEST_F(BadInput, TheDatabaseIsDown) {
  plant_.write_settings(R"({"results": {"connection": "host=/nowhere dbname=x"},
                            "historians": [{"connection": "host=/nowhere dbname=x"}]})");
  for (const char* command : {"once", "migrate", "check-config"}) {
    EXPECT_EQ(plant_.loopscope(command).exit_code, 4) << command;
  }
  expect_error(plant_.loopscope("once"), 4, "/nowhere");
}

TEST_F(BadInput, TheSchemaIsMissing) {
  plant_.sql("drop schema loopscope cascade");
  expect_error(plant_.loopscope("once"), 4, "loopscope migrate");
}

TEST_F(BadInput, TheHistoriansTableIsMissing) {
  plant_.import_loop("FIC101");
  plant_.sql("drop table history");
  const ProgramResult pass = plant_.loopscope("once");
  expect_error(pass, 4, "history");
  EXPECT_THAT(pass.out, HasSubstr("1 failed"));
  EXPECT_EQ(plant_.loopscope("check-config").exit_code, 4);
  expect_nothing_stored();
}

TEST_F(BadInput, ARoleWithoutRightsIsToldWhichItNeeds) {
  plant_.sql("drop role if exists stranger_" + std::to_string(1));
  plant_.sql("create role stranger_1 login");
  std::string text = Plant::settings();
  text.replace(text.find("@RESULTS@"), 9, "@RESULTS@ user=stranger_1");
  plant_.write_settings(text);
  const ProgramResult result = plant_.loopscope("once");
  EXPECT_EQ(result.exit_code, 4) << result.err;
  EXPECT_THAT(result.err, HasSubstr("permission denied"));
  EXPECT_THAT(result.err, HasSubstr("HINT: "));
  plant_.sql("drop role stranger_1");
}

TEST_F(BadInput, ImportRefusesWhatItCannotPlace) {
  const std::string file = plant_.import_loop("FIC101");
  const std::string count = "select count(*) from history";
  const std::string before = plant_.sql(count);
  expect_error(plant_.loopscope("import", {"--loop", "FIC101", file}), 2, "already has rows");
  const ProgramResult unplaced =
      plant_.loopscope("import", {"--loop", "FIC101", "--replace", file});
  expect_error(unplaced, 2, "HINT: say with --end TIME");
  EXPECT_EQ(unplaced.err.find("--replace"), std::string::npos)
      << "that was given: " << unplaced.err;
  expect_error(plant_.loopscope("import", {"--loop", "X", write("bad.csv", "t_s,pv\n0,1\n1,x\n")}),
               5, "line 3");
  expect_error(plant_.loopscope("import", {"--loop", "X", "--source", "moon", file}), 3, "moon");
  expect_error(plant_.loopscope("import", {"--loop", "", file}), 2, "name is empty");
  expect_error(plant_.loopscope("import", {"--loop", "X", "--period-s", "3e13", file}), 2, "range");
  EXPECT_EQ(plant_.sql(count), before);
  EXPECT_EQ(plant_.sql("select count(*) from loopscope.loop"), "1");
}

TEST_F(BadInput, RecordingsWithTheirOwnTimesAreNotLaidOverThemselves) {
  const std::string file =
      write("iso.csv", "time,sp,pv,op\n2024-03-01T00:00:00Z,1,2,3\n2024-03-01T00:00:10Z,1,2,3\n");
  EXPECT_EQ(plant_.loopscope("import", {"--loop", "X", "--create-table", file}).exit_code, 0);
  expect_error(plant_.loopscope("import", {"--loop", "X", file}), 2, "already has rows");
  expect_error(plant_.loopscope("import", {"--loop", "Y", "--end", "2026-01-01", file}), 2,
               "--end");
  EXPECT_EQ(plant_.loopscope("import", {"--loop", "X", "--replace", file}).exit_code, 0);
  EXPECT_EQ(plant_.sql("select count(*) from history"), "6");
}

TEST_F(BadInput, AFullDiskBehindStandardOutputIsNoSuccess) {
  const ProgramResult result = run_program(
      {"/bin/sh", "-c", std::string(LOOPSCOPE_PROGRAM) + " simulate --list > /dev/full"});
  EXPECT_NE(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("standard output"));
}

TEST_F(BadInput, LoopsAreLoadedAllOrNone) {
  const std::string bad = write("loops.csv", "name,pv_tag,period_s\nA,A.PV,60\nB,B.PV,-1\n");
  expect_error(plant_.loopscope("loops", {"load", bad}), 5, "line 3");
  EXPECT_EQ(plant_.sql("select count(*) from loopscope.loop"), "0");
  expect_error(plant_.loopscope("loops", {"set", "nobody", "--period-s", "60"}), 2, "nobody");
  expect_error(plant_.loopscope("loops", {"add", "A"}), 2, "pv tag is empty");
}

TEST_F(BadInput, LoopsRoundTripThroughCsvWithHostileNames) {
  plant_.import_loop("FIC101");
  const std::string hostile = "x'; drop table loopscope.loop; --\\\"";
  ASSERT_EQ(plant_.loopscope("loops", {"add", hostile, "--pv-tag", "a,\"b\"'"}).exit_code, 0);
  const std::string file = plant_.folder() / "out.csv";
  ASSERT_EQ(plant_.loopscope("loops", {"export", file}).exit_code, 0);
  const ProgramResult loaded = plant_.loopscope("loops", {"load", file});
  EXPECT_THAT(loaded.out, HasSubstr("0 loops added, 0 changed, 2 as before"));
  EXPECT_EQ(plant_.sql("select name from loopscope.loop order by loop_id desc limit 1"), hostile);
  EXPECT_THAT(plant_.loopscope("once").out, HasSubstr("2 loops: 2 new"));
  EXPECT_EQ(plant_.loopscope("loops", {"disable", hostile}).exit_code, 0);
  EXPECT_THAT(plant_.loopscope("once").out, HasSubstr("1 loop: 0 new"));
}

}  // namespace
}  // namespace loopscope::tests
