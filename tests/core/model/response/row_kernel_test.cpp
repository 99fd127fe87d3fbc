#include "core/model/response/row_kernel.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

#include "tests/core/model/model_records.hpp"
#include "tests/support/each_processor.hpp"

namespace loopscope::core::model {
namespace {

/// Signals of an odd number, rows that begin and end anywhere.
struct KernelSetting {
  static constexpr std::size_t kRows = 211;
  std::vector<tests::Series> series;
  std::vector<Signal> signals;
  std::vector<Range> rows{{3, 4}, {10, 18}, {20, 71}, {80, kRows}};

  KernelSetting() {
    for (std::uint64_t seed = 1; seed <= 7; ++seed)
      series.push_back(tests::white_noise(kRows, seed));
    for (const tests::Series& one : series) signals.push_back(one.data());
  }
};

std::vector<double> sums_by(const RowKernel& kernel, const KernelSetting& setting) {
  const std::size_t count = setting.signals.size();
  std::vector<double> sums(count * count, 1.0);
  kernel.add_products(setting.signals, setting.signals, setting.rows, sums.data(), count);
  return sums;
}

/// Of `count` copies of the last signal, each less another combination of three others.
std::vector<tests::Series> left_by(const RowKernel& kernel, const KernelSetting& setting,
                                   std::size_t count) {
  const std::vector<double> coefficients{0.5, -2.0, 0.1, 1.0, 0.0, 3.0, 0.7, -0.3,
                                         0.2, 0.9,  4.0, 0.6, 1.5, 0.4, -0.8};
  std::vector<tests::Series> left(count, setting.series.back());
  std::vector<double*> from;
  for (tests::Series& one : left) from.push_back(one.data());
  kernel.subtract(std::span(setting.signals).first(3), coefficients.data(), KernelSetting::kRows,
                  from);
  return left;
}

TEST(RowKernel, AddsProductsOverTheRows) {
  const KernelSetting setting;
  const std::vector<double> sums = sums_by(best_row_kernel(), setting);
  for (std::size_t i = 0; i < setting.signals.size(); ++i) {
    for (std::size_t j = 0; j < setting.signals.size(); ++j) {
      double sum = 1.0;
      for (const Range& range : setting.rows) {
        for (std::size_t k = range.first; k < range.end; ++k)
          sum += setting.signals[i][k] * setting.signals[j][k];
      }
      EXPECT_NEAR(sums[i * setting.signals.size() + j], sum, 1e-11);
    }
  }
}

TEST(RowKernel, IsTheSameOnEveryProcessor) {
  const KernelSetting setting;
  const auto kernels = loopscope::tests::on_each_processor([] { return &best_row_kernel(); });
  for (const RowKernel* kernel : kernels) {
    EXPECT_EQ(sums_by(*kernel, setting), sums_by(*kernels.front(), setting));
    EXPECT_EQ(left_by(*kernel, setting, 5), left_by(*kernels.front(), setting, 5));
  }
}

TEST(RowKernel, SubtractsFromManySignalsWhatItSubtractsFromEach) {
  const KernelSetting setting;
  const auto all = left_by(best_row_kernel(), setting, 5);
  for (std::size_t count = 1; count < 5; ++count) {
    const auto some = left_by(best_row_kernel(), setting, count);
    EXPECT_TRUE(std::equal(some.begin(), some.end(), all.begin()));
  }
  const tests::Series& last = setting.series.back();
  for (std::size_t k = 0; k < last.size(); ++k)
    EXPECT_NEAR(all[1][k], last[k] - setting.signals[0][k] - 3.0 * setting.signals[2][k], 1e-13);
}

}  // namespace
}  // namespace loopscope::core::model
