#include "core/loop/real_transform.hpp"

#include <algorithm>

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

RealTransform::Spectrum RealTransform::forward(std::vector<double> series) {
  series.resize(length_, 0.0);
  Spectrum spectrum(length_ / 2 + 1);
  fft_.fwd(spectrum.data(), series.data(), static_cast<Eigen::Index>(length_));
  return spectrum;
}

std::vector<double> RealTransform::inverse(const Spectrum& spectrum) {
  std::vector<double> series(length_);
  fft_.inv(series.data(), spectrum.data(), static_cast<Eigen::Index>(length_));
  return series;
}

}  // namespace loopscope::core::loop
