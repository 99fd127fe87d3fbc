#include "core/signal/flat_run.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/signal/archive.hpp"
#include "core/signal/order/order_statistic.hpp"

namespace loopscope::core::signal {
namespace {

/// The longest of n runs of one loop is hardly ever ten times the longest of those before.
constexpr double kTimesUsual = 10.0;
/// What fails may do so more than once in a window; what does so four times is the loop's way.
constexpr std::size_t kFurtherFailures = 2;
/// Of a run of 300 samples ten each: enough to average noise, enough blocks to see a slow course.
constexpr std::size_t kBlocks = 30;
/// Means of white noise spread over 4.1 of their standard deviations in thirty blocks, and over 8
/// in one record of a million.
constexpr double kWidestOfNoise = 8.0;
/// A course of one step of the grid of values is one reading more or less.
constexpr double kStepsOfCourse = 2.0;

double usual_difference(std::span<const double> samples) {
  std::vector<double> sizes;
  for (std::size_t k = 1; k < samples.size(); ++k) {
    const double size = std::abs(samples[k] - samples[k - 1]);
    if (std::isfinite(size)) sizes.push_back(size);
  }
  return sizes.empty() ? 0.0 : median(std::move(sizes));
}

/// Means of the recorded samples of each block.
std::vector<double> block_means(std::span<const double> samples) {
  std::vector<double> means;
  for (std::size_t block = 0; block < kBlocks; ++block) {
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t k = block * samples.size() / kBlocks;
         k < (block + 1) * samples.size() / kBlocks; ++k) {
      if (!std::isfinite(samples[k])) continue;
      sum += samples[k];
      count += 1.0;
    }
    if (count > 0.0) means.push_back(sum / count);
  }
  return means;
}

}  // namespace

std::vector<FlatRun> flat_runs(std::span<const double> samples) {
  std::vector<FlatRun> runs;
  FlatRun run;
  const auto close = [&] {
    if (run.recorded > 1) runs.push_back(run);
  };
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (!std::isfinite(samples[k])) continue;
    if (run.recorded == 0 || samples[k] != run.value) {
      close();
      run = {k, 0, samples[k]};
    } else {
      run.longest_gap = std::max(run.longest_gap, k - run.end());
    }
    run.samples = k + 1 - run.first;
    ++run.recorded;
  }
  close();
  return runs;
}

bool is_long(const FlatRun& run) {
  return run.samples >= kFewestFlatSamples &&
         (run.recorded >= kFewestFlatSamples || run.longest_gap <= kLongestBandedHole);
}

bool is_unusually_long(const FlatRun& run, std::span<const FlatRun> runs, double usual_before) {
  if (!is_long(run)) return false;
  std::vector<std::size_t> others;
  for (const FlatRun& other : runs) {
    if (other.first != run.first) others.push_back(other.recorded);
  }
  std::ranges::sort(others, std::greater{});
  const double usual =
      others.size() > kFurtherFailures ? static_cast<double>(others[kFurtherFailures]) : 1.0;
  return static_cast<double>(run.samples) >= kTimesUsual * std::max(usual, usual_before);
}

bool moves_beyond_noise(std::span<const double> samples, double step) {
  const double noise = kMadToSigma * usual_difference(samples) / std::numbers::sqrt2;
  const std::vector<double> means = block_means(samples);
  if (means.size() < 2) return false;
  const auto [low, high] = std::ranges::minmax(means);
  const double per_block = static_cast<double>(samples.size()) / static_cast<double>(kBlocks);
  const double of_noise = kWidestOfNoise * noise / std::sqrt(std::max(per_block, 1.0));
  return high - low > std::max(of_noise, kStepsOfCourse * step);
}

}  // namespace loopscope::core::signal
