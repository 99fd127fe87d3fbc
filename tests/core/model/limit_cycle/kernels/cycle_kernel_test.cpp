#include "core/model/limit_cycle/kernels/cycle_kernel.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <vector>

#include "tests/core/model/eight_series.hpp"
#include "tests/core/model/model_records.hpp"
#include "tests/support/each_processor.hpp"

namespace loopscope::core::model {
namespace {

using tests::append;
using tests::eight_noises;
using tests::Series;

constexpr std::size_t kRecord = 211;
constexpr std::size_t kBlock = 41;
constexpr BandWidths kWidths{25, 2};
constexpr std::array<LagStep, 6> kLags{{{0.0, 1.0, false},
                                        {0.5, 0.5, false},
                                        {0.7, 0.3, false},
                                        {0.9, 0.1, false},
                                        {1.0, 1.0, true},
                                        {0.2, 0.8, true}}};

std::vector<std::vector<EightNumbers>> responses_by(const CycleKernel& kernel) {
  std::vector<std::vector<EightNumbers>> sums(kLags.size());
  std::vector<EightNumbers*> firsts;
  for (auto& of_lag : sums) {
    of_lag.resize(kRecord + 1);
    firsts.push_back(of_lag.data());
  }
  kernel.respond(eight_noises(kRecord), kLags, firsts.data());
  return sums;
}

std::vector<EightNumbers> passed_by(const CycleKernel& kernel,
                                    const std::vector<EightNumbers>& sums) {
  std::vector<EightNumbers> passed(sums.size() - 1);
  kernel.pass(kWidths, flat(sums), kSideBySide, first_of(passed));
  return passed;
}

TEST(CycleKernel, RespondsAsEachLagDoesByItself) {
  const std::vector<EightNumbers> inputs = eight_noises(kRecord);
  const auto sums = responses_by(best_cycle_kernel());
  for (std::size_t place = 0; place < kSideBySide; ++place) {
    const Series input = series_at(place, inputs);
    double all = 0.0;
    for (const double value : input) all += value;
    const double mean = all / static_cast<double>(kRecord);
    for (std::size_t i = 0; i < kLags.size(); ++i) {
      double state = kLags[i].at_rest ? 0.0 : input[0] - mean, sum = 0.0;
      ASSERT_EQ(sums[i][0][place], 0.0);
      for (std::size_t k = 0; k < kRecord; ++k) {
        state = kLags[i].pole * state + kLags[i].share * (input[k] - mean);
        sum += state;
        ASSERT_EQ(sums[i][k + 1][place], sum);
      }
    }
  }
}

TEST(CycleKernel, PassesAndAveragesEachSeriesAsIfItWereAlone) {
  const CycleKernel& kernel = best_cycle_kernel();
  const auto sums = responses_by(kernel)[1];
  const std::vector<EightNumbers> passed = passed_by(kernel, sums);
  std::vector<EightNumbers> kept(kRecord / 3);
  kernel.resample(flat(passed), kSideBySide, 3, first_of(kept));
  for (std::size_t place = 0; place < kSideBySide; ++place) {
    Series alone(kRecord), kept_alone(kept.size());
    kernel.pass(kWidths, series_at(place, sums), 1, alone.data());
    kernel.resample(alone, 1, 3, kept_alone.data());
    EXPECT_EQ(series_at(place, passed), alone);
    EXPECT_EQ(series_at(place, kept), kept_alone);
  }
}

/// As Eigen adds whole arrays, block by block, where it is compiled for SSE2: pairs by turns.
TEST(CycleKernel, MultipliesInTheOrderOfArrays) {
  const CycleKernel& kernel = best_cycle_kernel();
  const std::vector<EightNumbers> sums = responses_by(kernel)[1];
  const std::vector<EightNumbers> responses = passed_by(kernel, sums);
  Series pv = tests::white_noise(kRecord, 30), weights(kRecord, 1.0), weighted = pv;
  for (std::size_t k = 50; k < 60; ++k) weights[k] = weighted[k] = 0.0;
  const std::array<std::size_t, 8> delays{0, 1, 2, 4, 39, 40, 41, 60};
  std::array<std::array<FoldSums, 2>, delays.size()> all_folds;
  kernel.multiply(kWidths, sums, delays, {weighted, weights, kBlock}, all_folds.data());
  for (std::size_t d = 0; d < delays.size(); ++d) {
    const std::size_t delay = delays[d];
    const auto& folds = all_folds[d];
    for (std::size_t place = 0; place < kSideBySide; ++place) {
      const Series response = series_at(place, responses);
      double cross[2] = {}, square[2] = {};
      for (std::size_t start = 0; start < kRecord; start += kBlock) {
        const std::size_t end = std::min(kRecord, start + kBlock), first = std::max(start, delay);
        if (first >= end) continue;
        const auto count = static_cast<Eigen::Index>(end - first);
        const Eigen::Map<const Eigen::ArrayXd> x(response.data() + (first - delay), count);
        const Eigen::Map<const Eigen::ArrayXd> y(pv.data() + first, count);
        const Eigen::Map<const Eigen::ArrayXd> w(weights.data() + first, count);
        cross[start / kBlock % 2] += (w * x * y).sum();
        square[start / kBlock % 2] += (w * x * x).sum();
      }
      for (std::size_t fold = 0; fold < 2; ++fold) {
        EXPECT_DOUBLE_EQ(folds[fold].cross[place], cross[fold]);
        EXPECT_DOUBLE_EQ(folds[fold].square[place], square[fold]);
      }
    }
  }
}

std::vector<double> numbers_by(const CycleKernel& kernel) {
  std::vector<double> numbers;
  const Series pv = tests::white_noise(kRecord, 30), weights(kRecord, 1.0);
  for (const auto& sums : responses_by(kernel)) {
    const std::vector<EightNumbers> passed = passed_by(kernel, sums);
    std::vector<EightNumbers> kept(kRecord / 4);
    kernel.resample(flat(passed), kSideBySide, 4, first_of(kept));
    append(flat(sums), numbers);
    append(flat(passed), numbers);
    append(flat(kept), numbers);
    std::array<FoldSums, 2> folds;
    kernel.multiply(kWidths, sums, std::array<std::size_t, 1>{3}, {pv, weights, kBlock}, &folds);
    for (const FoldSums& fold : folds) {
      append(flat({&fold.cross, 1}), numbers);
      append(flat({&fold.square, 1}), numbers);
    }
  }
  return numbers;
}

TEST(CycleKernel, IsTheSameOnEveryProcessor) {
  const auto kernels = loopscope::tests::on_each_processor([] { return &best_cycle_kernel(); });
  for (const CycleKernel* kernel : kernels)
    EXPECT_EQ(numbers_by(*kernel), numbers_by(*kernels.front()));
}

}  // namespace
}  // namespace loopscope::core::model
