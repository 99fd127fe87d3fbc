#pragma once

#include <complex>
#include <cstddef>

#include "core/plant/envelope.hpp"

namespace loopscope::core::plant {

/// How far one oscillation follows another one: z(j) = gain r(j) + u(j).
struct Following {
  double p = 1.0;  ///< that two loops which know nothing of each other go together so closely
  std::complex<double> gain = 0.0;  ///< least squares
  double followed = 0.0;            ///< mean square of gain r
  double rest = 0.0;                ///< mean square of u
  std::size_t points = 0;           ///< in common
};

/// Whether `envelope` and `course` belong together.
///
/// p: generalised least squares of either on the other with a disturbance of its own,
/// u(j) = a u(j - 1) + e(j), a complex (Cochrane and Orcutt 1949): (s1 / s0)^(n - 3) with the mean
/// squares of e with and without the other one, which is the law of the squared coherence of two
/// complex series of which one is white (Goodman 1963); twice the smaller of both directions, since
/// noise in the regressor hides what a clean series follows. Because a loop's own rhythm is
/// foreseen by `a` first, two loops of near-equal periods that know nothing of each other do not go
/// together, and neither does a resonance; the closer two steady lines are, the less is left that
/// could speak. p = 1 with fewer than eight points in common.
[[nodiscard]] Following follow(const Envelope& envelope, const Envelope& course);

}  // namespace loopscope::core::plant
