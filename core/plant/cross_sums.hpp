#pragma once

#include <complex>
#include <cstddef>

#include "core/plant/envelope.hpp"

namespace loopscope::core::plant {

/// Sums over the points at which both of two envelopes, z and r, are known now and one point
/// before.
struct CrossSums {
  using Complex = std::complex<double>;

  double zz = 0.0, rr = 0.0;       ///< |z|^2, |r|^2, now
  double zz1 = 0.0, rr1 = 0.0;     ///< before
  Complex zr = 0.0, zr1 = 0.0;     ///< z conj(r), now with now, before with before
  Complex z_z1 = 0.0, r_r1 = 0.0;  ///< now with before
  Complex z_r1 = 0.0, r_z1 = 0.0;
  std::size_t count = 0;
};

/// Sums over the points at which both are known.
struct PointSums {
  std::complex<double> zr = 0.0;
  double zz = 0.0, rr = 0.0;
  std::size_t count = 0;
};

struct EnvelopeSums {
  CrossSums pairs;
  PointSums points;
};

[[nodiscard]] EnvelopeSums sum_over_common(const Envelope& z, const Envelope& r);

}  // namespace loopscope::core::plant
