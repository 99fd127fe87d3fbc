#include <csignal>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/end_to_end/plant.hpp"

namespace loopscope::tests {
namespace {

using testing::HasSubstr;

/// Waits until the query gives the answer; false after `seconds`.
bool becomes(const Plant& plant, const std::string& query, const std::string& answer,
             int seconds = 20) {
  for (int tries = 0; tries < 10 * seconds; ++tries) {
    if (plant.sql(query) == answer) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return false;
}

TEST(Monitor, EveryLoopEndsAsOneRowAndASecondPassAddsNothing) {
  const Plant plant;
  for (unsigned seed = 1; seed <= 5; ++seed)
    plant.import_loop("loop " + std::to_string(seed), 1000, seed);
  const ProgramResult first = plant.loopscope("once");
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_THAT(first.out, HasSubstr("5 loops: 5 new"));
  const std::string counts =
      "select (select count(*) from loopscope.analysis), (select count(*) from loopscope.verdict)";
  EXPECT_EQ(plant.sql(counts), "5|5");
  const std::string stamp = "select max(analysed_at) from loopscope.analysis";
  const std::string before = plant.sql(stamp);
  EXPECT_THAT(plant.loopscope("once").out, HasSubstr("5 loops: 0 new, 0 revised, 5 unchanged"));
  EXPECT_EQ(plant.sql(counts), "5|5");
  EXPECT_EQ(plant.sql(stamp), before);
}

TEST(Monitor, TheRowSaysWhatAnalyzeSays) {
  const Plant plant;
  const std::string file = plant.import_loop("FIC101", 4500, 7);
  ASSERT_EQ(plant.loopscope("once").exit_code, 0);
  const ProgramResult alone = run_program({LOOPSCOPE_PROGRAM, "analyze", file, "--json"});
  const auto json = nlohmann::json::parse(alone.out);
  EXPECT_EQ(plant.sql("select samples from loopscope.analysis"), "4096");
  const auto row = [&](const std::string& column) {
    return std::stod(plant.sql("select " + column + " from loopscope.analysis"));
  };
  for (const char* column : {"ngi", "nli", "mean_bic2", "skewness"}) {
    EXPECT_DOUBLE_EQ(row(column), json["hos"][column].get<double>()) << column;
  }
  EXPECT_DOUBLE_EQ(row("harris_low"), json["performance"]["harris_low"].get<double>());
  EXPECT_EQ(plant.sql("select code from loopscope.latest_verdict"), json["verdict"]["code"]);
  EXPECT_EQ(std::stoul(plant.sql("select count(*) from loopscope.bicoherence_peak")),
            json["hos"]["peaks"].size());
}

TEST(Monitor, LateDataReviseTheRowOnceAndKeepTheFormerVerdict) {
  const Plant plant;
  plant.import_loop("FIC101");
  ASSERT_EQ(plant.loopscope("once").exit_code, 0);
  plant.sql(
      "update history set value = value + 3 where tag = 'FIC101.PV' and time = (select "
      "max(time) - interval '500 seconds' from history)");
  EXPECT_THAT(plant.loopscope("once").out, HasSubstr("1 revised"));
  EXPECT_EQ(plant.sql("select count(*), max(input_revision) from loopscope.analysis"), "1|2");
  EXPECT_EQ(plant.sql("select count(*) from loopscope.verdict"), "2");
  EXPECT_EQ(plant.sql("select count(*) from loopscope.latest_verdict"), "1");
  EXPECT_THAT(plant.loopscope("once").out, HasSubstr("1 unchanged"));
}

TEST(Monitor, LoopsWithoutDataAreAFindingThatDoesNotRepeat) {
  const Plant plant;
  plant.import_loop("FIC101");
  EXPECT_EQ(plant.loopscope("loops", {"add", "ghost", "--pv-tag", "NOWHERE"}).exit_code, 0);
  EXPECT_THAT(plant.loopscope("once").out, HasSubstr("2 loops: 2 new"));
  EXPECT_EQ(plant.sql("select code from loopscope.latest_verdict v join loopscope.loop l using "
                      "(loop_id) where l.name = 'ghost'"),
            "insufficient_data");
  EXPECT_THAT(plant.loopscope("once").out, HasSubstr("2 unchanged"));
}

TEST(Monitor, OneLoopOfAnUnknownSourceStopsNothingElse) {
  const Plant plant;
  plant.import_loop("FIC101");
  ASSERT_EQ(plant.loopscope("loops", {"add", "stray", "--pv-tag", "x"}).exit_code, 0);
  plant.sql("update loopscope.loop set source = 'elsewhere' where name = 'stray'");
  const ProgramResult pass = plant.loopscope("once");
  EXPECT_EQ(pass.exit_code, 3) << pass.err;
  EXPECT_THAT(pass.out, HasSubstr("1 new"));
  EXPECT_THAT(pass.out, HasSubstr("1 failed"));
  EXPECT_THAT(pass.err, HasSubstr("no historian named \"elsewhere\""));
}

TEST(Monitor, TwoProcessesShareACatalogueWithoutDoingASlotTwice) {
  const Plant plant;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    plant.import_loop("loop " + std::to_string(seed), 600, seed);
  }
  plant.write_settings(
      Plant::settings(R"("schedule": {"batch_loops": 2}, "daemon": {"workers": 2})"));
  BackgroundProgram first(plant.command_line("once"), plant.folder() / "first.log");
  BackgroundProgram second(plant.command_line("once"), plant.folder() / "second.log");
  EXPECT_EQ(first.wait(60), 0) << content_of(plant.folder() / "first.log");
  EXPECT_EQ(second.wait(60), 0) << content_of(plant.folder() / "second.log");
  EXPECT_EQ(plant.sql("select count(*), count(distinct loop_id) from loopscope.analysis"), "40|40");
  EXPECT_EQ(plant.sql("select count(*), max(input_revision) from loopscope.verdict"), "40|1");
}

TEST(Monitor, LoopsThatAnotherWorkerHoldsAreCounted) {
  const Plant plant;
  plant.import_loop("FIC101");
  plant.import_loop("FIC102", 1000, 2);
  plant.sql(
      "update loopscope.schedule set owner = 'elsewhere', visible_at = now() + interval '1 h' "
      "where loop_id = (select min(loop_id) from loopscope.loop)");
  const ProgramResult pass = plant.loopscope("once");
  EXPECT_EQ(pass.exit_code, 0) << pass.err;
  EXPECT_THAT(pass.out, HasSubstr("1 loop: 1 new"));
  EXPECT_THAT(pass.out, HasSubstr("1 more are held by other workers"));
}

TEST(Monitor, AConnectionThatDiedIdleCostsNothing) {
  wait_for_hour_with(std::chrono::seconds(40));
  const Plant plant;
  plant.write_settings(Plant::settings(R"("schedule": {"poll_s": 0.2, "settle_s": 0})"));
  plant.import_loop("FIC101");
  BackgroundProgram daemon(plant.command_line("run"), plant.folder() / "daemon.log");
  ASSERT_TRUE(becomes(plant, "select count(*) from loopscope.analysis", "1"));
  plant.sql(
      "select pg_terminate_backend(pid) from pg_stat_activity where pid <> pg_backend_pid() "
      "and datname = current_database()");
  plant.import_loop("FIC102", 1000, 2);
  EXPECT_TRUE(becomes(plant, "select count(*) from loopscope.analysis", "2"));
  EXPECT_EQ(plant.sql("select max(attempts) from loopscope.schedule"), "0");
  daemon.send(SIGTERM);
  EXPECT_EQ(daemon.wait(20), 0);
}

TEST(Monitor, TheDaemonWorksUntilItIsTold) {
  wait_for_hour_with(std::chrono::seconds(40));
  const Plant plant;
  plant.write_settings(Plant::settings(R"("schedule": {"poll_s": 0.2, "settle_s": 0})"));
  plant.import_loop("FIC101");
  BackgroundProgram daemon(plant.command_line("run"), plant.folder() / "daemon.log");
  ASSERT_TRUE(becomes(plant, "select count(*) from loopscope.analysis", "1"));
  plant.import_loop("FIC102", 1000, 2);
  EXPECT_TRUE(becomes(plant, "select count(*) from loopscope.analysis", "2"));
  daemon.send(SIGTERM);
  EXPECT_EQ(daemon.wait(20), 0);
  EXPECT_THAT(content_of(plant.folder() / "daemon.log"), HasSubstr("stopped: 2 loops: 2 new"));
  EXPECT_EQ(plant.sql("select count(*) from loopscope.schedule where owner is not null"), "0");
}

TEST(Monitor, ABadSettingsFileOnReloadLeavesTheOldOneInForce) {
  wait_for_hour_with(std::chrono::seconds(40));
  const Plant plant;
  plant.write_settings(Plant::settings(R"("schedule": {"poll_s": 0.2, "settle_s": 0})"));
  const std::string log = plant.folder() / "daemon.log";
  BackgroundProgram daemon(plant.command_line("run"), log);
  plant.import_loop("FIC101");
  ASSERT_TRUE(becomes(plant, "select count(*) from loopscope.analysis", "1"));
  plant.write_settings("{ \"nonsense\": 1 }");
  daemon.send(SIGHUP);
  for (int k = 0; k < 100 && content_of(log).find("old settings stay") == std::string::npos; ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_THAT(content_of(log), HasSubstr("the old settings stay in force"));
  plant.write_settings(Plant::settings(R"("schedule": {"poll_s": 0.3, "settle_s": 0})"));
  daemon.send(SIGHUP);
  plant.import_loop("FIC102", 1000, 2);
  EXPECT_TRUE(becomes(plant, "select count(*) from loopscope.analysis", "2"));
  EXPECT_THAT(content_of(log), HasSubstr("settings read again"));
  daemon.send(SIGTERM);
  EXPECT_EQ(daemon.wait(20), 0);
}

}  // namespace
}  // namespace loopscope::tests
