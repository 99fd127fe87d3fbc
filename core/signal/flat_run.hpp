#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace loopscope::core::signal {

/// Samples that all have one value, whatever is missing among them; it begins and ends with a
/// recorded one.
struct FlatRun {
  std::size_t first = 0;
  std::size_t samples = 0;  ///< from the first to the last
  double value = 0.0;
  std::size_t recorded = 0;     ///< of the samples
  std::size_t longest_gap = 0;  ///< missing samples in a row
  [[nodiscard]] std::size_t end() const { return first + samples; }
};

/// Half a minute of a scanned archive, five minutes of samples of a second: no process that is
/// controlled is as calm, unless its grid hides it.
inline constexpr std::size_t kFewestFlatSamples = 300;

/// All runs of two samples or more, in their order.
[[nodiscard]] std::vector<FlatRun> flat_runs(std::span<const double> samples);

/// Whether the run has kFewestFlatSamples, of which that many are recorded or no more than
/// kLongestBandedHole (archive.hpp) are missing in a row.
[[nodiscard]] bool is_long(const FlatRun& run);

/// Whether `run`, one of `runs`, is long and ten times as long as what is usual: the third
/// longest of the others (what fails may do so more than once, and for less long), and
/// `usual_before`, samples, known from elsewhere.
[[nodiscard]] bool is_unusually_long(const FlatRun& run, std::span<const FlatRun> runs,
                                     double usual_before = 0.0);

/// Whether samples move by more than their noise does: the means of thirty blocks spread wider than
/// those of white noise with the same differences from sample to sample, and than two steps of the
/// grid of values. `step`: of that grid, in the samples' unit, 0 = none. NaN is left out.
[[nodiscard]] bool moves_beyond_noise(std::span<const double> samples, double step);

}  // namespace loopscope::core::signal
