#pragma once

#include <cstddef>
#include <span>

namespace loopscope::core::model {

/// The most likely place where the mean of a series changes.
struct ChangePoint {
  double p = 1.0;
  std::size_t at_sample = 0;  ///< first sample after the change
  double before = 0.0;        ///< mean of the recorded samples before it
  double after = 0.0;
};

/// The cumulative sum of `increments` about its end, which has mean 0 throughout when nothing
/// changes. Time is counted in the squares of the increments, so that the bridge is Brownian
/// whatever their variance does; its largest distance from 0 is judged by Kolmogorov's law. The
/// place is the largest distance over its standard deviation within the middle 96 %. Increments of
/// 0 are missing samples; p = 1 when all are. Means in the unit of the increments.
[[nodiscard]] ChangePoint find_change(std::span<const double> increments);

}  // namespace loopscope::core::model
