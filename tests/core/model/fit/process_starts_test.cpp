#include "core/model/fit/process_starts.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>

#include "core/model/effects/saturation.hpp"
#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::size_t kStartSamples = 900;
constexpr std::size_t kLongest = 20;

LoopData delayed_record() {
  const tests::Series op = tests::stepping_op(kStartSamples, 1);
  return make_loop_data(tests::process_record(tests::one_lag(0.8, 4), 1.5, op,
                                              tests::white_noise(kStartSamples, 2, 0.3)),
                        op, 1.0);
}

/// pv on the answer of that very shape, sample by sample; before the record there was nothing.
double error_of(const LoopData& data, const Structure& structure, ProcessShape shape) {
  const std::size_t delay = shape.delay_samples;
  shape.delay_samples = 0;
  std::vector<double> flow = data.op;
  for (const EffectPtr& effect : structure.effects) effect->shape_flow(flow);
  std::vector<double> s(flow.size()), pv(flow.size());
  respond(shape, flow, s);
  whiten(structure.noise, s, s);
  whiten(structure.noise, data.pv, pv);
  double square = 0.0, both = 0.0, total = 0.0;
  for (const Range& range : data.rows.fit) {
    for (std::size_t k = range.first; k < range.end; ++k) {
      const double moved = k < delay ? 0.0 : s[k - delay];
      square += moved * moved;
      both += moved * pv[k];
      total += pv[k] * pv[k];
    }
  }
  return total - both * both / square;
}

void expect_starts_the_slow_way(const LoopData& data, const Structure& structure) {
  ProcessShape vessel = tests::integrator(0);
  const std::array shapes = {tests::one_lag(0.8, 0), tests::two_lags(0.9, 0.6, 0), vessel};
  const auto starts = process_starts(data, structure, kLongest, shapes);
  ASSERT_EQ(starts.size(), shapes.size() * kLongest);
  for (const ProcessStart& start : starts) {
    const double error = error_of(data, structure, start.shape);
    EXPECT_NEAR(start.error, error, 1e-9 * start.total) << start.shape.delay_samples;
  }
}

TEST(ProcessStarts, LeaveWhatOneShapeAtATimeLeaves) {
  const LoopData data = delayed_record();
  Structure structure;
  expect_starts_the_slow_way(data, structure);
  structure.noise = {2, {0.98, 0.5, 0.0}, {-0.4, 0.1, 0.0}};
  expect_starts_the_slow_way(data, structure);
  structure.effects.push_back(std::make_shared<Saturation>(-5.0, 5.0));
  expect_starts_the_slow_way(data, structure);
}

TEST(ProcessStarts, RowsThatBeginBeforeTheDelayReadNothing) {
  LoopData data = delayed_record();
  data.rows.fit.insert(data.rows.fit.begin(), Range{0, 10});
  expect_starts_the_slow_way(data, {});
}

TEST(ProcessStarts, TheBestIsTheProcess) {
  const LoopData data = delayed_record();
  const std::array shapes = {tests::one_lag(0.5, 0), tests::one_lag(0.8, 0),
                             tests::one_lag(0.95, 0)};
  const auto starts = process_starts(data, {}, kLongest, shapes);
  const auto best = std::ranges::min_element(starts, {}, &ProcessStart::error);
  EXPECT_EQ(best->shape.delay_samples, 4U);
  EXPECT_EQ(best->shape.pole, 0.8);
}

/// pv seen at every seventh sample shows every delay all the same.
TEST(ProcessStarts, OfAHeldSensorTriesEveryDelayWithinARow) {
  constexpr std::size_t kMany = 4000;
  const tests::Series op = tests::stepping_op(kMany, 1);
  const tests::Series pv =
      tests::process_record(tests::one_lag(0.8, 11), 1.5, op, tests::white_noise(kMany, 2, 0.1));
  const LoopData data = make_loop_data(pv, op, 1.0, {7, 3});
  const std::array shapes = {tests::one_lag(0.5, 0), tests::one_lag(0.8, 0)};
  const auto starts = process_starts(data, {}, kLongest, shapes);
  EXPECT_EQ(starts.size(), shapes.size() * kLongest);
  const auto best = std::ranges::min_element(starts, {}, &ProcessStart::error);
  EXPECT_EQ(best->shape.delay_samples, 11U);
  EXPECT_EQ(best->shape.pole, 0.8);
  for (std::size_t delay = 1; delay <= kLongest; ++delay) {
    EXPECT_EQ(std::ranges::count(starts, delay,
                                 [](const ProcessStart& s) { return s.shape.delay_samples; }),
              2);
  }
}

TEST(ProcessStarts, ARowMayBeLongerThanTheLongestDelay) {
  const LoopData data = delayed_record();
  LoopData sparse = make_loop_data(data.pv, data.op, 1.0, {30, 0});
  const std::array shapes = {tests::one_lag(0.8, 0)};
  EXPECT_EQ(process_starts(sparse, {}, kLongest, shapes).size(), kLongest);
}

}  // namespace
}  // namespace loopscope::core::model
