// Loops that oscillate slowly: a longer span is read, counted into the digest and stored.

#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <thread>

#include "tests/end_to_end/plant.hpp"

namespace loopscope::tests {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

/// The first so many samples of the loop's history.
constexpr std::size_t kHistory = 12'000;
/// Sixty segments at every 17th sample (core/hos/slow_look.hpp).
constexpr const char* kSpan = "8976";

class SlowLook : public testing::Test {
 protected:
  /// A loop of period 204 samples with a coupled second harmonic, one sample in ten seconds.
  std::string import_slow(const std::string& name, unsigned seed, std::size_t samples = kHistory) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> noise(0.0, 0.3);
    const std::string file = plant_.folder() / (name + ".csv");
    std::ofstream text(file);
    text << "t_s,sp,pv,op\n";
    for (std::size_t k = 0; k < samples; ++k) {
      const double phase = 2.0 * std::numbers::pi * static_cast<double>(k) / 204.0 + seed;
      const double error = std::cos(phase) + 0.3 * std::cos(2.0 * phase) + noise(random);
      text << 10 * k << ",50," << 50.0 - error << ',' << 50.0 + 2.0 * error << '\n';
    }
    text.close();
    const ProgramResult imported =
        plant_.loopscope("import", {"--create-table", "--loop", name, file});
    EXPECT_EQ(imported.exit_code, 0) << imported.err;
    return file;
  }

  [[nodiscard]] std::string once() const {
    const ProgramResult pass = plant_.loopscope("once");
    EXPECT_EQ(pass.exit_code, 0) << pass.err;
    return pass.out;
  }

  [[nodiscard]] std::string of(const std::string& loop, const std::string& column) const {
    return plant_.sql("select " + column +
                      " from loopscope.analysis join loopscope.loop using "
                      "(loop_id) where name = '" +
                      loop + "'");
  }

  /// Adds 1 to the sample of pv that lies so many samples before the newest.
  void disturb(const std::string& loop, int samples_back) const {
    plant_.sql("update history set value = value + 1 where tag = '" + loop +
               ".PV' and time = (select max(time) from history where tag = '" + loop +
               ".PV') - interval '10 seconds' * " + std::to_string(samples_back));
  }

  Plant plant_;
};

TEST_F(SlowLook, ALongerSpanIsReadAndASecondPassAddsNothing) {
  const std::string file = import_slow("SLOW", 1);
  EXPECT_THAT(once(), HasSubstr("1 loop: 1 new"));
  EXPECT_EQ(of("SLOW", "samples"), "4096");
  EXPECT_EQ(of("SLOW", "hos_slow->>'samples'"), kSpan);
  EXPECT_EQ(of("SLOW", "hos_slow->>'segments'"), "60");
  const std::string stamp = of("SLOW", "analysed_at");
  EXPECT_THAT(once(), HasSubstr("1 loop: 0 new, 0 revised, 1 unchanged"));
  EXPECT_EQ(of("SLOW", "analysed_at"), stamp);

  const ProgramResult alone = run_program({LOOPSCOPE_PROGRAM, "analyze", file, "--json"});
  const Json expected = Json::parse(alone.out)["hos_slow"];
  const Json stored = Json::parse(of("SLOW", "hos_slow"));
  EXPECT_EQ(stored.size(), expected.size());
  EXPECT_EQ(stored["decimation"], expected["decimation"]);
  for (const char* key : {"ngi", "nli", "mean_bic2"}) {
    EXPECT_NEAR(stored[key].get<double>(), expected[key].get<double>(), 1e-12) << key;
  }
}

TEST_F(SlowLook, LateRowsOfTheLongerSpanReviseTheRowAndOlderOnesDoNot) {
  import_slow("SLOW", 2);
  ASSERT_THAT(once(), HasSubstr("1 new"));
  disturb("SLOW", 6000);
  EXPECT_THAT(once(), HasSubstr("1 revised"));
  EXPECT_THAT(once(), HasSubstr("1 unchanged"));
  disturb("SLOW", 10'000);
  EXPECT_THAT(once(), HasSubstr("1 unchanged"));
  EXPECT_EQ(of("SLOW", "input_revision"), "2");
}

TEST_F(SlowLook, HistoryThatIsFilledInLaterRevisesTheRow) {
  import_slow("SLOW", 3);
  plant_.sql(
      "create table older as select * from history where time < (select max(time) from "
      "history) - interval '10 seconds' * 4200");
  plant_.sql(
      "delete from history where exists (select from older where older.tag = history.tag and "
      "older.time = history.time)");
  ASSERT_THAT(once(), HasSubstr("1 new"));
  EXPECT_THAT(once(), HasSubstr("1 unchanged"));
  EXPECT_EQ(of("SLOW", "(hos_slow->>'samples')::int < 4300"), "t");
  plant_.sql("insert into history select * from older");
  EXPECT_THAT(once(), HasSubstr("1 revised"));
  EXPECT_EQ(of("SLOW", "hos_slow->>'samples'"), kSpan);
}

TEST_F(SlowLook, LoopsOfOneBatchKeepTheirOwnRows) {
  plant_.import_loop("FAST 1", 1000, 1);
  const std::string first = import_slow("SLOW 1", 4);
  plant_.import_loop("FAST 2", 5000, 2);
  const std::string second = import_slow("SLOW 2", 5);
  ASSERT_EQ(plant_.loopscope("loops", {"add", "ghost", "--pv-tag", "NOWHERE"}).exit_code, 0);
  EXPECT_THAT(once(), HasSubstr("5 loops: 5 new"));
  EXPECT_THAT(once(), HasSubstr("5 unchanged"));
  EXPECT_EQ(of("FAST 1", "hos_slow is null") + of("FAST 2", "hos_slow is null"), "tt");
  for (const auto& [loop, file] : {std::pair{"SLOW 1", first}, std::pair{"SLOW 2", second}}) {
    const ProgramResult alone = run_program({LOOPSCOPE_PROGRAM, "analyze", file, "--json"});
    const double expected = Json::parse(alone.out)["hos_slow"]["ngi"].get<double>();
    EXPECT_NEAR(std::stod(of(loop, "hos_slow->>'ngi'")), expected, 1e-12) << loop;
  }
}

TEST_F(SlowLook, NothingMoreIsReadWhereTheSettingForbidsIt) {
  import_slow("SLOW", 6);
  plant_.write_settings(Plant::settings(R"("analysis": {"slow_span_windows": 1})"));
  EXPECT_THAT(once(), HasSubstr("1 new"));
  EXPECT_EQ(of("SLOW", "hos_slow->>'samples'"), "4096");
  EXPECT_THAT(once(), HasSubstr("1 unchanged"));
  plant_.write_settings(Plant::settings());
  EXPECT_THAT(once(), HasSubstr("1 revised"));
  EXPECT_EQ(of("SLOW", "hos_slow->>'samples'"), kSpan);
}

TEST_F(SlowLook, TheDaemonReadsLongerSpansToo) {
  wait_for_hour_with(std::chrono::seconds(30));
  plant_.write_settings(Plant::settings(R"("schedule": {"poll_s": 0.2, "settle_s": 0})"));
  import_slow("SLOW", 7);
  BackgroundProgram daemon(plant_.command_line("run"), plant_.folder() / "daemon.log");
  std::string samples;
  for (int tries = 0; tries < 200 && samples.empty(); ++tries) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    samples = of("SLOW", "hos_slow->>'samples'");
  }
  EXPECT_EQ(samples, kSpan);
  daemon.send(SIGTERM);
  EXPECT_EQ(daemon.wait(20), 0);
}

}  // namespace
}  // namespace loopscope::tests
