#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>

#include "core/simulate/scenario.hpp"
#include "daemon/failure.hpp"
#include "daemon/recording/recording.hpp"
#include "daemon/simulate/effect_text.hpp"
#include "daemon/simulate/record_csv.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::daemon {
namespace {

using core::simulate::LoopRecord;
using core::simulate::simulate_scenario;
using core::simulate::ValveStiction;
using tests::TemporaryFolder;

std::string hint_of(const std::string& effect) {
  try {
    (void)parse_effect(effect);
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit_code(), ExitCode::usage);
    return failure.hint();
  }
  return "accepted";
}

std::size_t files_in(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

TEST(EffectText, ReadsNameAndParameters) {
  const auto effect = parse_effect("valve_stiction:S=3,J=1,law=kano");
  EXPECT_EQ(std::get<ValveStiction>(effect).law, core::simulate::StictionLaw::kano);
  EXPECT_EQ(std::get<ValveStiction>(effect).slip_jump_percent, 1.0);
  EXPECT_NO_THROW((void)parse_effect("sensor_hold"));
}

TEST(EffectText, NamesTheNearestKnownName) {
  EXPECT_THAT(hint_of("valve_stictoin:S=3"), testing::HasSubstr("\"valve_stiction\""));
  EXPECT_THAT(hint_of("valve_deadband:widht=3"), testing::HasSubstr("\"width\""));
  EXPECT_THAT(hint_of("valve_deadband:width"), testing::HasSubstr("width=2"));
  EXPECT_THAT(hint_of("valve_deadband:width=wide"), testing::HasSubstr("width=2"));
  EXPECT_THAT(hint_of("valve_deadband:width=3,"), testing::HasSubstr("width=2"));
  EXPECT_THROW(require_scenario("paper_5_9"), Failure);
  EXPECT_NO_THROW(require_scenario("paper_5_4"));
}

TEST(RecordCsv, ReadsBackBitForBit) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "loop.csv";
  const LoopRecord record = simulate_scenario("paper_5_4", {}, 1);
  write_whole_file(file, record_csv(record, true));
  const auto window = last_window(read_recording(file), 4096, {});
  EXPECT_EQ(window.sample_interval_s, 1.0);
  EXPECT_EQ(window.sp, record.sp);
  EXPECT_EQ(window.pv, record.pv);
  EXPECT_EQ(window.op, record.op);
  EXPECT_EQ(window.mv, record.mv);
}

TEST(RecordCsv, LeavesOutWhatThereIsNot) {
  core::simulate::ScenarioOptions two;
  two.samples = 2;
  const std::string signal = record_csv(simulate_scenario("paper_4_1_linear", two, 1), true);
  EXPECT_THAT(signal, testing::StartsWith("t_s,sp,pv\n0,0,"));
  const std::string loop = record_csv(simulate_scenario("paper_5_1", two, 1), false);
  EXPECT_THAT(loop, testing::StartsWith("t_s,sp,pv,op\n0,50,"));
}

TEST(WriteWholeFile, ReplacesAFileAndLeavesNothingBeside) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "out.csv";
  write_whole_file(file, "first");
  write_whole_file(file, "second");
  std::ifstream stream(file);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(stream), {}), "second");
  EXPECT_EQ(files_in(folder.path()), 1U);
}

TEST(WriteWholeFile, SaysWhichFileCannotBeWritten) {
  const TemporaryFolder folder;
  try {
    write_whole_file(folder.path() / "missing" / "out.csv", "text");
    FAIL() << "written into a folder that does not exist";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit_code(), ExitCode::usage);
    EXPECT_THAT(failure.what(), testing::HasSubstr("out.csv"));
  }
  // A folder cannot be replaced by a file: the partial file must go again.
  std::filesystem::create_directory(folder.path() / "taken");
  EXPECT_THROW(write_whole_file(folder.path() / "taken", "text"), Failure);
  EXPECT_EQ(files_in(folder.path()), 1U);
}

}  // namespace
}  // namespace loopscope::daemon
