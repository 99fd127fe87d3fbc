#pragma once

#include <complex>

#include "core/plant/envelope.hpp"

namespace loopscope::core::plant {

/// Least squares of one envelope on another, over the points that both have.
struct CommonGain {
  std::complex<double> gain = 0.0;  ///< of `envelope` by `reference`
  double followed = 0.0;            ///< mean square that follows the reference
  double rest = 0.0;                ///< mean square that does not
  std::size_t points = 0;
};
[[nodiscard]] CommonGain common_gain(const Envelope& envelope, const Envelope& reference);

}  // namespace loopscope::core::plant
