#include "core/loop/real_transform.hpp"

#include <algorithm>
#include <utility>

namespace loopscope::core::loop {

std::size_t fast_length(std::size_t least) {
  std::size_t power = 4;
  while (power < least) power *= 2;
  std::size_t best = power;
  for (const std::size_t candidate : {power / 8 * 5, power / 4 * 3}) {
    if (candidate >= least && candidate % 4 == 0) best = std::min(best, candidate);
  }
  return best;
}

RealTransform::Spectrum RealTransform::forward(std::vector<double> series) const {
  return fft_->transform(std::move(series));
}

std::vector<double> RealTransform::inverse(Spectrum spectrum) const {
  return fft_->inverse(std::move(spectrum));
}

}  // namespace loopscope::core::loop
