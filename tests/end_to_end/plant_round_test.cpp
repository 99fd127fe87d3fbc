#include <array>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/end_to_end/plant.hpp"

namespace loopscope::tests {
namespace {

using testing::HasSubstr;

/// sp, pv and op of a recording.
using Rows = std::vector<std::array<double, 3>>;

Rows rows_of(const std::string& file) {
  std::ifstream text(file);
  std::string line;
  std::getline(text, line);
  Rows rows;
  for (double t_s = 0.0; std::getline(text, line);) {
    std::array<double, 3> row{};
    if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf", &t_s, &row[0], &row[1], &row[2]) == 4)
      rows.push_back(row);
  }
  return rows;
}

/// A loop downstream of `source`: its pv gets the source's error through a lag of `lag` samples and
/// with noise of its own, and its PI controller works against that.
std::string downstream_csv(const Rows& source, double lag, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, 0.1);
  std::ostringstream text;
  text.precision(17);
  text << "t_s,sp,pv,op\n";
  double process = 0.0, op = 50.0, load = 0.0, before = 0.0;
  for (std::size_t k = 0; k < source.size(); ++k) {
    load += ((source[k][1] - source[k][0]) - load) / lag;
    const double pv = 50.0 + process + load + noise(random);
    const double error = 50.0 - pv;
    op += 0.1 * (error - before) + 0.01 * error;
    before = error;
    process += (0.5 * (op - 50.0) - process) / 5.0;
    text << k << ",50," << pv << ',' << op << '\n';
  }
  return text.str();
}

/// A valve that sticks, three loops downstream of it, and two that have nothing to do with it.
class PlantRound : public testing::Test {
 protected:
  void SetUp() override {
    wait_for_hour_with(std::chrono::seconds(60));
    import_plant("");
  }
  void import_plant(const std::string& schedule) {
    plant.write_settings(Plant::settings(R"("schedule": {"settle_s": 0)" + schedule + "}"));
    const std::string sticking = plant.folder() / "sticking.csv";
    std::vector<std::string> simulate = plant.command_line("simulate");
    simulate = {simulate[0], "simulate", "sticking_valve", "--seed", "5", "--out", sticking};
    ASSERT_EQ(run_program(simulate).exit_code, 0);
    import("FIC1", sticking);
    const Rows source = rows_of(sticking);
    for (int k = 0; k < 3; ++k) {
      const std::string file = plant.folder() / ("downstream" + std::to_string(k) + ".csv");
      std::ofstream(file) << downstream_csv(source, 6.0 + 6.0 * k, 10U + static_cast<unsigned>(k));
      import("TIC" + std::to_string(k), file);
    }
    for (unsigned k = 0; k < 2; ++k) {
      const std::string file = plant.folder() / ("quiet" + std::to_string(k) + ".csv");
      std::ofstream(file) << noisy_loop_csv(4096, 20 + k);
      import("PIC" + std::to_string(k), file);
    }
  }
  void import(const std::string& loop, const std::string& file) const {
    const ProgramResult done = plant.loopscope("import", {"--create-table", "--loop", loop, file});
    ASSERT_EQ(done.exit_code, 0) << done.err;
  }
  [[nodiscard]] std::string members() const {
    return plant.sql(
        "select string_agg(loop_name || ' ' || role, ', ' order by loop_name) from "
        "loopscope.plant_oscillation_member where is_current");
  }
  Plant plant;
};

constexpr const char* kOneSource = "FIC1 source, TIC0 victim, TIC1 victim, TIC2 victim";

TEST_F(PlantRound, OneEventWithOneSourceAndNobodyElseOnTheWorkList) {
  const ProgramResult pass = plant.loopscope("once");
  ASSERT_EQ(pass.exit_code, 0) << pass.err;
  EXPECT_THAT(pass.err, HasSubstr("6 loops compared"));
  EXPECT_EQ(plant.sql("select loops, events from loopscope.plant_round"), "6|1");
  EXPECT_EQ(members(), kOneSource) << pass.err;
  EXPECT_EQ(plant.sql("select string_agg(loop_name || ' ' || code, ', ') from "
                      "loopscope.flagged_loop"),
            "FIC1 valve_stiction");
  EXPECT_EQ(plant.sql("select jsonb_array_length(traces), jsonb_array_length(leads) > 3,"
                      " cardinality(array_remove(reasons, '')), outside > 0"
                      " from loopscope.plant_oscillation"),
            "4|t|4|t");
  const std::string notices = plant.sql("select count(*) from loopscope.flag_notice");
  EXPECT_EQ(notices, "1");

  // The same data give the same round.
  ASSERT_EQ(plant.loopscope("once").exit_code, 0);
  EXPECT_EQ(plant.sql("select count(*) from loopscope.plant_round"), "1");
  EXPECT_EQ(plant.sql("select count(*) from loopscope.flag_notice"), notices);
}

TEST_F(PlantRound, IsOneBoxInTheReport) {
  ASSERT_EQ(plant.loopscope("once").exit_code, 0);
  const std::string folder = plant.folder() / "report";
  const ProgramResult made = plant.loopscope("report", {"--out", folder});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const std::string page = content_of(plant.folder() / "report" / "report.html");
  for (const char* part : {"id=\"oscillation-1\"", "Where it comes from", "Trends of sp",
                           "Spectra of sp", "Who follows whom", "class=\"sharing\""})
    EXPECT_THAT(page, HasSubstr(part));
}

TEST_F(PlantRound, IsMadeByTheDaemonOnItsSchedule) {
  plant.write_settings(Plant::settings(
      R"("plant": {"round_s": 0.5, "notice_s": 0.5}, "schedule": {"poll_s": 0.5, "settle_s": 0})"));
  BackgroundProgram daemon(plant.command_line("run"), plant.folder() / "daemon.log");
  for (int tries = 0; tries < 600 && members() != kOneSource; ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_EQ(members(), kOneSource) << content_of(plant.folder() / "daemon.log");
  daemon.send(SIGTERM);
  EXPECT_EQ(daemon.wait(30), 0);
}

/// A plant whose slots move by less than half of the windows, so that these are kept.
class RoundOfKeptRows : public PlantRound {
 protected:
  void SetUp() override {
    // Nothing becomes due on the way.
    while (std::time(nullptr) % 1800 > 1650) std::this_thread::sleep_for(std::chrono::seconds(1));
    import_plant(R"(, "default_period_s": 1800)");
  }
};

TEST_F(RoundOfKeptRows, AsksTheHistorianForNothing) {
  plant.write_settings(Plant::settings(
      R"("plant": {"round_s": 0.5, "notice_s": 0.5}, "schedule": {"poll_s": 0.5, "settle_s": 0})"));
  BackgroundProgram daemon(plant.command_line("run"), plant.folder() / "daemon.log");
  const auto becomes = [&](const std::string& what) {
    for (int tries = 0; tries < 600 && members() != what; ++tries)
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    return members() == what;
  };
  ASSERT_TRUE(becomes(kOneSource)) << content_of(plant.folder() / "daemon.log");
  plant.sql("delete from history");
  const std::string rounds = "select count(*) from loopscope.plant_round";
  // One that has read before may be stored afterwards.
  for (int more = 0; more < 2; ++more) {
    plant.sql("delete from loopscope.plant_round");
    for (int tries = 0; tries < 300 && plant.sql(rounds) == "0"; ++tries)
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  EXPECT_TRUE(becomes(kOneSource)) << content_of(plant.folder() / "daemon.log");
  EXPECT_EQ(plant.sql("select loops from loopscope.plant_round order by 1 limit 1"), "6");
  daemon.send(SIGTERM);
  EXPECT_EQ(daemon.wait(30), 0);
}

TEST_F(PlantRound, ARoundThatFailsKeepsNoFlagBack) {
  plant.write_settings(
      Plant::settings(R"("plant": {"round_s": 0.5, "notice_s": 0}, "schedule": {"settle_s": 0})"));
  ASSERT_EQ(plant.loopscope("once").exit_code, 0);
  ASSERT_EQ(plant.sql("select count(*) from loopscope.flag_notice"), "0") << "nobody asked";
  plant.sql("delete from loopscope.plant_round; alter table history rename to away");
  plant.write_settings(Plant::settings(
      R"("plant": {"round_s": 0.5, "notice_s": 0.5}, "schedule": {"poll_s": 0.5, "settle_s": 0})"));
  BackgroundProgram daemon(plant.command_line("run"), plant.folder() / "daemon.log");
  const auto notices = [&] { return plant.sql("select count(*) from loopscope.flag_notice"); };
  for (int tries = 0; tries < 300 && notices() == "0"; ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_NE(notices(), "0");
  EXPECT_EQ(plant.sql("select count(*) from loopscope.plant_round"), "0") << "it failed";
  daemon.send(SIGTERM);
  EXPECT_EQ(daemon.wait(30), 0);
}

TEST_F(PlantRound, WhoeverKeepsTheTurnIsNamed) {
  plant.sql(
      "UPDATE loopscope.task_lease SET owner = 'host/9', hold_s = 3600,"
      " until = now() + interval '1 h' WHERE task = 'plant_round'");
  const ProgramResult pass = plant.loopscope("once");
  ASSERT_EQ(pass.exit_code, 0) << pass.err;
  EXPECT_THAT(pass.err, HasSubstr("plant round: left to host/9, who has the turn"));
  EXPECT_EQ(plant.sql("select count(*) from loopscope.plant_round"), "0");
  plant.write_settings(Plant::settings(
      R"("plant": {"round_s": 0.5, "notice_s": 0.1}, "schedule": {"poll_s": 0.5, "settle_s": 0})"));
  const std::string log = plant.folder() / "daemon.log";
  BackgroundProgram daemon(plant.command_line("run"), log);
  const std::string words = "plant round: host/9 has had the turn at 10 polls in a row";
  // Looks rest for twenty times as long as one takes.
  for (int tries = 0; tries < 1200 && content_of(log).find(words) == std::string::npos; ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_THAT(content_of(log), HasSubstr(words));
  daemon.send(SIGTERM);
  EXPECT_EQ(daemon.wait(30), 0);
}

}  // namespace
}  // namespace loopscope::tests
