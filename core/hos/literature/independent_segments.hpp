#pragma once

#include <cstddef>

#include "core/hos/transforms/settings.hpp"

namespace loopscope::core::hos {

/// Settings under which the textbook null of bispectral tests holds: segments that share no sample
/// (no overlap) and bins that share no energy (no taper, no zero padding), so that squared
/// bicoherences of white Gaussian noise are independent but for what a shared frequency does.
///
/// Segments are the even number of samples next below sqrt(`samples`), 16 at least: Hinich (1982)
/// smooths over more than sqrt(N) triple products for a consistent bispectrum, and so many segments
/// are the same amount of smoothing. 64 for 4096 samples. All else as in Settings.
[[nodiscard]] Settings independent_segments(std::size_t samples);

}  // namespace loopscope::core::hos
