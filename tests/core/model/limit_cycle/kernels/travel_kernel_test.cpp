#include "core/model/limit_cycle/kernels/travel_kernel.hpp"

#include <gtest/gtest.h>
#include <vector>

#include "tests/core/model/eight_series.hpp"
#include "tests/core/model/model_records.hpp"
#include "tests/support/each_processor.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::size_t kMeans = 101;

std::vector<double> numbers_by(const TravelKernel& kernel) {
  const std::vector<EightNumbers> flows = tests::eight_noises(kMeans);
  const tests::Series pv = tests::white_noise(kMeans, 20), trend = tests::white_noise(kMeans, 21);
  std::vector<std::vector<EightNumbers>> lagged(kTravelPoles.size());
  std::vector<EightNumbers*> firsts;
  for (auto& of_lag : lagged) {
    of_lag.resize(kMeans);
    firsts.push_back(of_lag.data());
  }
  kernel.lag(flows, firsts.data());
  std::vector<double> numbers;
  for (const auto& of_lag : lagged) tests::append(flat(of_lag), numbers);
  const std::vector<Range> ranges{{0, 5}, {12, 18}, {90, kMeans}};
  for (const std::size_t delay : kTravelDelays) {
    const TravelSums sums = kernel.sum(firsts[2], delay, ranges, trend.data(), pv.data());
    tests::append(flat({&sums.sum, 1}), numbers);
    tests::append(flat({&sums.with_trend, 1}), numbers);
    tests::append(flat({&sums.square, 1}), numbers);
    tests::append(flat({&sums.with_pv, 1}), numbers);
  }
  return numbers;
}

// What it computes is held by TravelFit, EqualsTheFitOfEveryLagToTheLastDigit.
TEST(TravelKernel, IsTheSameOnEveryProcessor) {
  const auto kernels = loopscope::tests::on_each_processor([] { return &best_travel_kernel(); });
  for (const TravelKernel* kernel : kernels)
    EXPECT_EQ(numbers_by(*kernel), numbers_by(*kernels.front()));
}

}  // namespace
}  // namespace loopscope::core::model
