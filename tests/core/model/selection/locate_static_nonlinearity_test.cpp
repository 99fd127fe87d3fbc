#include "core/model/selection/locate_static_nonlinearity.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "core/model/selection/selection_round.hpp"
#include "core/model/selection/stepwise_model.hpp"
#include "tests/core/model/everything_asked.hpp"
#include "tests/core/model/model_records.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::uint64_t kBentRecords = 10;
using loopscope::tests::kWindow;
constexpr double kMiddle = 50.0;

tests::Series op_of(std::uint64_t seed) {
  return tests::stepping_op(kWindow, seed, 20.0);
}

tests::Series noise_of(std::uint64_t seed) {
  return tests::white_noise(kWindow, seed + 100, 0.5);
}

/// Equal percentage about the middle, R = 20.
double bent(double distance) {
  const double growth = std::log(20.0) / 100.0;
  return std::expm1(growth * distance) / growth;
}

ProcessShape slow() {
  return tests::one_lag(0.9, 2);
}

/// op enters the process through `map`.
template <class Map>
tests::Series through_valve(const tests::Series& op, std::uint64_t seed, Map map) {
  tests::Series flow = op;
  for (double& value : flow) value = kMiddle + map(value - kMiddle);
  return tests::process_record(slow(), 1.0, flow, noise_of(seed));
}

/// What the process answers is bent.
tests::Series through_process(const tests::Series& op, std::uint64_t seed) {
  tests::Series pv = tests::process_record(slow(), 1.0, op, tests::Series(kWindow, 0.0));
  for (double& value : pv) value = kMiddle + bent(value - kMiddle);
  return tests::sum(pv, noise_of(seed));
}

std::vector<CandidateFit> contest(const tests::Series& pv, const tests::Series& op) {
  const StepwiseModel stepwise = start_selection(make_loop_data(pv, op, 1.0));
  const Nominations asked = tests::everything_asked();
  return run_selection_round({stepwise.data, stepwise.data, stepwise.last(), asked}).trials;
}

template <class Make>
void expect_first(EffectKind kind, Make make) {
  for (std::uint64_t seed = 1; seed <= kBentRecords; ++seed) {
    const tests::Series op = op_of(seed);
    const auto trials = contest(make(op, seed), op);
    ASSERT_FALSE(trials.empty());
    EXPECT_EQ(trials.front().kind(), kind) << seed;
    EXPECT_TRUE(trials.front().enters()) << seed;
  }
}

TEST(TellBendsApart, ABentValve) {
  expect_first(EffectKind::valve_characteristic, [](const tests::Series& op, std::uint64_t seed) {
    return through_valve(op, seed, bent);
  });
}

TEST(TellBendsApart, ABentProcess) {
  expect_first(EffectKind::process_nonlinearity, through_process);
}

TEST(TellBendsApart, AValveThatStopsShort) {
  expect_first(EffectKind::valve_saturation, [](const tests::Series& op, std::uint64_t seed) {
    return through_valve(op, seed, [](double distance) { return std::min(distance, 8.0); });
  });
}

/// The contest has settled it: another look changes nothing, and nobody drops out.
TEST(TellBendsApart, SettlesItOnce) {
  const tests::Series op = op_of(1);
  const tests::Series pv = through_process(op, 1);
  std::vector<CandidateFit> trials = contest(pv, op);
  std::vector<EffectKind> before, after;
  for (const CandidateFit& trial : trials) before.push_back(trial.kind());
  locate_static_nonlinearity(make_loop_data(pv, op, 1.0), trials);
  for (const CandidateFit& trial : trials) after.push_back(trial.kind());
  EXPECT_EQ(before.front(), after.front());
  std::ranges::sort(before);
  std::ranges::sort(after);
  EXPECT_EQ(before, after);
}

TEST(TellBendsApart, LeavesOtherCausesAlone) {
  std::vector<CandidateFit> none;
  locate_static_nonlinearity(LoopData(), none);
  EXPECT_TRUE(none.empty());
}

}  // namespace
}  // namespace loopscope::core::model
