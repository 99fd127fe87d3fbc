#include "core/signal/flat_run.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/signal/archive.hpp"
#include "core/signal/median.hpp"

namespace loopscope::core::signal {
namespace {

/// Half a minute of a scanned archive, five minutes of samples of a second: no process that is
/// controlled is as calm, unless its grid hides it.
constexpr std::size_t kFewestSamples = 300;
/// The longest of n runs of one loop is hardly ever ten times the longest of those before.
constexpr double kTimesUsual = 10.0;
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
    if (run.samples > 1) runs.push_back(run);
  };
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (!std::isfinite(samples[k])) continue;
    const bool goes_on =
        run.samples > 0 && samples[k] == run.value && k - (run.end() - 1) <= kLongestBandedHole + 1;
    if (!goes_on) {
      close();
      run = {k, 0, samples[k]};
    }
    run.samples = k + 1 - run.first;
  }
  close();
  return runs;
}

FlatRun longest_run(std::span<const FlatRun> runs) {
  const auto longest = std::ranges::max_element(runs, {}, &FlatRun::samples);
  return longest == runs.end() ? FlatRun{} : *longest;
}

bool is_unusually_long(const FlatRun& run, std::span<const FlatRun> runs, double usual_before) {
  std::size_t longest = 1;
  std::size_t second = 1;
  for (const FlatRun& other : runs) {
    if (other.first == run.first) continue;
    second = std::max(second, std::min(longest, other.samples));
    longest = std::max(longest, other.samples);
  }
  const auto usual = static_cast<double>(longest < kFewestSamples ? longest : second);
  return run.samples >= kFewestSamples &&
         static_cast<double>(run.samples) >= kTimesUsual * std::max(usual, usual_before);
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
