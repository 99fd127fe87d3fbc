#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace loopscope::core::signal {

/// Samples that all have one value. Missing ones among them do not end it as long as no more than
/// kLongestBandedHole (archive.hpp) lie in a row; it begins and ends with a recorded one.
struct FlatRun {
  std::size_t first = 0;
  std::size_t samples = 0;
  double value = 0.0;
  [[nodiscard]] std::size_t end() const { return first + samples; }
};

/// All runs of two samples or more, in their order.
[[nodiscard]] std::vector<FlatRun> flat_runs(std::span<const double> samples);

/// The longest, the first of several; samples = 0 where there is none.
[[nodiscard]] FlatRun longest_run(std::span<const FlatRun> runs);

/// Whether `run`, one of `runs`, is 300 samples long and ten times as long as what is usual: the
/// longest of the others, or the second of them where that has 300, too (a transmitter that fails
/// may do so twice); and `usual_before`, samples, known from elsewhere.
[[nodiscard]] bool is_unusually_long(const FlatRun& run, std::span<const FlatRun> runs,
                                     double usual_before = 0.0);

/// Whether samples move by more than their noise does: the means of thirty blocks spread wider than
/// those of white noise with the same differences from sample to sample. `step`: of the grid of
/// values, 0 = none. NaN is left out.
[[nodiscard]] bool moves_beyond_noise(std::span<const double> samples, double step);

}  // namespace loopscope::core::signal
