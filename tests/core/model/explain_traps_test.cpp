#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>

#include "core/diagnosis/diagnose.hpp"
#include "core/model/explain.hpp"
#include "core/simulate/scenario.hpp"
#include "tests/core/model/model_records.hpp"
#include "tests/support/chance.hpp"
#include "tests/support/long_run.hpp"

/// The two ways to a model that fits and means nothing: a loop that was never excited, and the
/// controller run backwards.
namespace loopscope::core::model {
namespace {

constexpr std::uint64_t kTrapRecords = 40;
std::uint64_t trap_records() {
  return loopscope::tests::records(kTrapRecords);
}

/// So many of kTrapRecords.
int at_most(int bound) {
  return loopscope::tests::at_most(bound, kTrapRecords, trap_records());
}

TEST(ExplainTraps, ConstantOpClaimsNothing) {
  simulate::LoopRecord record = simulate::simulate_scenario("sticking_valve", {}, 1);
  record.op.assign(record.op.size(), 42.0);
  EXPECT_FALSE(tests::explain_record(record));
  for (std::size_t k = 0; k < record.op.size(); k += 500) record.op[k] = 42.001;
  const auto explanation = tests::explain_record(record);
  EXPECT_TRUE(!explanation || !explanation->excited);
}

/// op moves, pv does not care: neither excited by it nor any effect of valve or process.
TEST(ExplainTraps, AnOpThatPvDoesNotFollowClaimsNothing) {
  int excited = 0, claimed = 0;
  for (std::uint64_t seed = 1; seed <= trap_records(); ++seed) {
    const tests::Series op = tests::stepping_op(4096, seed);
    const NoiseModel noise{1, {0.98, 0.0, 0.0}, {-0.4, 0.0, 0.0}};
    const tests::Series pv = tests::coloured_noise(noise, 4096, seed + 500, 1.0);
    const tests::Series sp(4096, 0.0), error = tests::scaled(pv, -1.0);
    const auto explanation = explain({pv, op, sp, error, 1.0});
    if (!explanation) continue;
    excited += explanation->excited;
    claimed += tests::claims_hardware(*explanation);
  }
  std::printf("independent op: excited %d, claimed %d of %d\n", excited, claimed,
              static_cast<int>(trap_records()));
  EXPECT_LE(claimed, at_most(2));
  EXPECT_LE(excited, at_most(4));
}

/// op is what a PI controller makes of pv, and the valve is shut off: the only law in the record is
/// the controller's.
tests::Series controller_output(const tests::Series& error) {
  tests::Series op(error.size(), 50.0);
  for (std::size_t k = 1; k < op.size(); ++k) {
    op[k] = op[k - 1] + 0.5 * (error[k] - error[k - 1]) + 0.05 * error[k];
  }
  return op;
}

TEST(ExplainTraps, AControllerAloneIsNoFaultyValveOrProcess) {
  int claimed = 0;
  for (std::uint64_t seed = 1; seed <= trap_records(); ++seed) {
    const NoiseModel load{1, {0.9, 0.0, 0.0}, {-0.3, 0.0, 0.0}};
    const tests::Series pv = tests::coloured_noise(load, 4096, seed, 1.0);
    const tests::Series sp(4096, 0.0), error = tests::scaled(pv, -1.0);
    const auto explanation = explain({pv, controller_output(error), sp, error, 1.0, false});
    claimed += explanation && tests::claims_hardware(*explanation);
  }
  std::printf("controller alone: claimed %d of %d\n", claimed, static_cast<int>(trap_records()));
  EXPECT_LE(claimed, at_most(2));
}

/// A historian that stamps op one sample early shows pv(k) = -op(k-1) / C, without error: behind
/// the sample of delay that the model has, the fit finds the controller run backwards.
TEST(ExplainTraps, AFitThatFindsTheControllerIsRefused) {
  int believed = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    simulate::LoopRecord record = simulate::simulate_scenario("healthy_flow", {}, seed);
    record.op.erase(record.op.begin());
    record.op.push_back(record.op.back());
    const auto explanation = tests::explain_record(record);
    believed += explanation && explanation->excited && explanation->process_doubt.empty();
  }
  std::printf("op one sample early: believed %d of 10\n", believed);
  EXPECT_LE(believed, 1);
}

/// A right model of a loop at rest is no controller run backwards.
TEST(ExplainTraps, RightModelsAreNotDoubted) {
  int doubted = 0;
  for (std::uint64_t seed = 1; seed <= trap_records(); ++seed) {
    const auto explanation = tests::explain_scenario("healthy_flow", seed);
    ASSERT_TRUE(explanation);
    doubted += !explanation->process_doubt.empty();
  }
  std::printf("healthy_flow: doubted %d of %d\n", doubted, static_cast<int>(trap_records()));
  EXPECT_LE(doubted, at_most(4));
}

/// An outside sinusoid is odd and makes op and pv run a quarter of a cycle apart, which Horch's
/// cross-correlation takes for a sticking valve (paper, section 5.3).
TEST(ExplainTraps, HorchsSinusoidIsFromOutside) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const simulate::LoopRecord record = simulate::simulate_scenario("paper_5_3", {}, seed);
    signal::LoopWindow window;
    window.sample_interval_s = record.sample_interval_s;
    window.sp = record.sp;
    window.pv = record.pv;
    window.op = record.op;
    EXPECT_EQ(diagnose(window, {}).verdict.code, diagnosis::VerdictCode::external_disturbance)
        << seed;
  }
}

}  // namespace
}  // namespace loopscope::core::model
