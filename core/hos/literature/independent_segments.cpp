#include "core/hos/literature/independent_segments.hpp"

#include <algorithm>
#include <cmath>

namespace loopscope::core::hos {

Settings independent_segments(std::size_t samples) {
  constexpr std::size_t kShortest = 16;
  constexpr std::size_t kLongest = 4096;
  const auto root = static_cast<std::size_t>(std::sqrt(static_cast<double>(samples)));
  Settings settings;
  settings.segment_length = std::clamp(root - root % 2, kShortest, kLongest);
  settings.dft_length = settings.segment_length;
  settings.overlap = 0.0;
  settings.window = WindowShape::rectangular;
  return settings;
}

}  // namespace loopscope::core::hos
