#include "core/plant/common_gain.hpp"

#include <algorithm>
#include <cmath>

namespace loopscope::core::plant {

CommonGain common_gain(const Envelope& envelope, const Envelope& reference) {
  CommonGain result;
  std::complex<double> cross = 0.0;
  double power = 0.0, own = 0.0;
  const std::int64_t from = std::max(envelope.first, reference.first);
  const std::int64_t to = std::min(envelope.end(), reference.end());
  for (std::int64_t j = from; j < to; ++j) {
    const std::complex<double> z = envelope.at(j), r = reference.at(j);
    if (!std::isfinite(z.real()) || !std::isfinite(r.real())) continue;
    cross += z * std::conj(r);
    power += std::norm(r);
    own += std::norm(z);
    ++result.points;
  }
  if (!(power > 0.0)) return result;
  const auto count = static_cast<double>(result.points);
  result.gain = cross / power;
  result.followed = std::norm(cross) / power / count;
  result.rest = std::max(0.0, own / count - result.followed);
  return result;
}

}  // namespace loopscope::core::plant
