#include "core/model/fit/batched/lane_kernel.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>

#include "tests/core/model/model_records.hpp"
#include "tests/support/each_processor.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::size_t kLaneSamples = 1500;

/// Those that this processor can run, the fastest last; the first runs everywhere.
std::vector<const LaneKernel*> runnable_lane_kernels() {
  return loopscope::tests::on_each_processor([] { return &best_lane_kernel(); });
}

/// op about its mean, what pv answers, whitened columns, one of them silent at both ends, and rows
/// that begin and end anywhere.
struct LaneSetting {
  tests::Series op = tests::stepping_op(kLaneSamples, 3);
  tests::Series pv = tests::process_record(tests::one_lag(0.8, 3), 1.5, op,
                                           tests::white_noise(kLaneSamples, 8, 0.2));
  std::vector<tests::Series> columns;
  std::vector<Signal> signals;
  std::vector<Range> rows{{40, 63}, {64, 65}, {130, 301}, {302, 306}, {500, kLaneSamples}};

  LaneSetting() {
    for (double& value : op) value -= 50.0;
    for (std::uint64_t seed = 4; seed < 11; ++seed)
      columns.push_back(tests::white_noise(kLaneSamples, seed));
    std::fill_n(columns[2].begin(), 400, 0.0);
    for (const tests::Series& column : columns) signals.push_back(column.data());
  }
};

TEST(LaneKernel, TheBestOneIsAmongThem) {
  const std::vector<const LaneKernel*> kernels = runnable_lane_kernels();
  ASSERT_FALSE(kernels.empty());
  EXPECT_EQ(&best_lane_kernel(), kernels.back());
}

/// As many lane_valves as leave some lanes idle, of every law, at the samples and between them.
std::vector<ValveEffect> lane_valves() {
  std::vector<ValveEffect> result;
  for (const ValveLaw law : {ValveLaw::choudhury, ValveLaw::kano, ValveLaw::he}) {
    for (int i = 0; i < 37; ++i) {
      const double band = 0.3 + 0.2 * i;
      result.emplace_back(Valve{law, band, 0.02 * i * band, 1.0});
      const BetweenSamples between{0.03 + 0.02 * i, 0.03 * (i % 5), 0.002 * (i % 3)};
      if (law != ValveLaw::choudhury)
        result.emplace_back(Valve{law, band, 0.02 * i * band, 1.0, between, 0.1 * i});
    }
  }
  return result;
}

TEST(LaneKernel, AnswersOfValvesAreTheSame) {
  const LaneSetting setting;
  const NoiseModel noise{2, {0.97, 0.4, 0.0}, {-0.6, 0.1, 0.0}};
  const ResponseTask task{setting.op, noise, 2, setting.signals, setting.rows};
  const std::vector<ValveEffect> all = lane_valves();
  const ProcessShape process = tests::two_lags(0.9, 0.5, 4);
  std::vector<ValveAndProcess> pairs;
  for (const ValveEffect& valve : all) pairs.push_back({&valve, &process});
  const std::vector<const LaneKernel*> kernels = runnable_lane_kernels();
  const auto single = kernels.front()->single_answers(task, pairs);
  const auto full = kernels.front()->full_answers(task, pairs);
  for (const LaneKernel* kernel : kernels) {
    EXPECT_EQ(kernel->single_answers(task, pairs), single) << kernel->name;
    EXPECT_EQ(kernel->full_answers(task, pairs), full) << kernel->name;
  }
}

}  // namespace
}  // namespace loopscope::core::model
