#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "core/simulate/scenario.hpp"
#include "daemon/lab/simulate/effect_text.hpp"
#include "daemon/lab/simulate/parse_numbers.hpp"
#include "daemon/lab/simulate/record_csv.hpp"
#include "daemon/recording/recording.hpp"
#include "daemon/text/failure.hpp"
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

TEST(EffectText, ReadsNameAndParameters) {
  const auto effect = parse_effect("valve_stiction:S=3,J=1,law=kano");
  EXPECT_EQ(std::get<ValveStiction>(effect).law, core::simulate::StictionLaw::kano);
  EXPECT_EQ(std::get<ValveStiction>(effect).slip_jump_percent, 1.0);
  EXPECT_NO_THROW((void)parse_effect("sensor_hold"));
}

std::string refused_effect(const std::string& effect) {
  try {
    (void)parse_effect(effect);
  } catch (const Failure& failure) {
    return std::string(failure.what()) + " HINT: " + failure.hint();
  }
  return "accepted";
}

TEST(EffectText, SaysWhatIsWrongAndWhatToWrite) {
  EXPECT_EQ(refused_effect("valve_stictoin"),
            "unknown effect \"valve_stictoin\" HINT: did you mean \"valve_stiction\"?");
  EXPECT_EQ(refused_effect("xyzxyz"),
            "unknown effect \"xyzxyz\" HINT: loopscope simulate --list shows every effect");
  EXPECT_EQ(refused_effect("valve_deadband:width"),
            "effect valve_deadband: \"width\" is not NAME=VALUE HINT: parameters: width=2 (full "
            "width, % of op)");
  EXPECT_EQ(refused_effect("valve_deadband:widht=3"),
            "effect valve_deadband: unknown parameter \"widht\" HINT: did you mean \"width\"?");
  EXPECT_EQ(refused_effect("valve_deadband:width=3,width=4"),
            "effect valve_deadband: parameter \"width\" stands twice HINT: give it once; a second "
            "effect of the kind takes a second --effect");
  EXPECT_EQ(
      refused_effect("valve_deadband:width=wide"),
      "valve_deadband: width=wide is not a number HINT: parameters: width=2 (full width, % of "
      "op)");
  EXPECT_EQ(refused_effect("sensor_hold:samples=2.5"),
            "sensor_hold: samples is not a whole number from 1 to 10000 HINT: parameters: "
            "samples=10");
}

TEST(EffectText, NamesTheNearestKnownName) {
  EXPECT_THAT(hint_of("valve_stictoin:S=3"), testing::HasSubstr("\"valve_stiction\""));
  EXPECT_THAT(hint_of("valve_deadband:widht=3"), testing::HasSubstr("\"width\""));
  EXPECT_THAT(hint_of("valve_deadband:width"), testing::HasSubstr("width=2"));
  EXPECT_THAT(hint_of("valve_deadband:width=wide"), testing::HasSubstr("width=2"));
  EXPECT_THAT(hint_of("valve_deadband:width=3,"), testing::HasSubstr("width=2"));
  EXPECT_THAT(hint_of("valve_stiction:S=1,S=2"), testing::HasSubstr("give it once"));
  EXPECT_THROW(require_scenario("paper_5_9"), Failure);
  EXPECT_NO_THROW(require_scenario("paper_5_4"));
}

TEST(RecordCsv, ReadsBackBitForBit) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "loop.csv";
  const LoopRecord record = simulate_scenario("paper_5_4", {}, 1);
  std::ofstream(file) << record_csv(record, true);
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

std::string refused_seed(const std::string& text) {
  try {
    (void)parse_seed(text);
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit_code(), ExitCode::usage);
    EXPECT_THAT(failure.hint(), testing::HasSubstr("0 to 18446744073709551615"));
    return failure.what();
  }
  return "accepted";
}

TEST(NumberText, ASeedIsAWholeNumberThatFits) {
  EXPECT_EQ(parse_seed("0"), 0U);
  EXPECT_EQ(parse_seed("18446744073709551615"), std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(parse_seed("010"), 10U);
  for (const char* text : {"-1", "18446744073709551616", "1e3", "1.0", "0x1", "+1", " 1", ""}) {
    EXPECT_THAT(refused_seed(text), testing::HasSubstr(std::string("\"") + text + "\"")) << text;
  }
}

TEST(NumberText, AnIntervalIsBetweenAMicrosecondAndAMillionSeconds) {
  EXPECT_EQ(parse_interval_s("1e-6"), 1e-6);
  EXPECT_EQ(parse_interval_s("1e6"), 1e6);
  for (const char* text :
       {"nan", "inf", "1e308", "1e999", "0", "-1", "9e-7", "1000001", "ten", "1,5", ""}) {
    EXPECT_THROW((void)parse_interval_s(text), Failure) << text;
  }
}

}  // namespace
}  // namespace loopscope::daemon
