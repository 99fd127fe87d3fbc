#pragma once

#include <vector>

#include "core/plant/envelope.hpp"

namespace loopscope::core::plant {

/// How one oscillation wanders about its own mean course, ready to be compared: what is left of the
/// phase's steps and of the amplitude when their own past has been taken off.
struct Increments {
  Envelope envelope;
  std::vector<double> phase;      ///< radians, white; NaN where unknown; entry k is of point k
  std::vector<double> amplitude;  ///< likewise, in the envelope's unit
};
[[nodiscard]] Increments measure_increments(Envelope envelope);

/// Whether two oscillations keep step.
struct Synchrony {
  double p = 1.0;            ///< that two independent oscillators do so well
  double frequency_p = 1.0;  ///< of their frequencies lying so close within one resolution
  double phase_p = 1.0;      ///< of their phases wandering together
  double amplitude_p = 1.0;  ///< of their amplitudes doing so
  std::size_t points = 0;    ///< in common
};

/// Null: two oscillators of smooth spectrum that know nothing of each other, near-equal periods
/// included. Three signs:
/// - frequency: the difference D of the two frequencies is where the product of one envelope with
///   the conjugate of the other has its periodogram's peak, over the time T in common. Within the
///   resolution 1/T independent periods fall anywhere, so that p = |D| T, at least 0.02; farther
///   apart it is 1.
/// - phase and amplitude: correlation, at a delay of at most one period, of what the own past of
///   each does not foresee (Haugh 1976), which is a t statistic when one of the two is white.
/// Perfect lines show the first only: p is twice the smaller of that alone and of all three by
/// Fisher's rule. So two of them are never joined, several are.
/// p = 1 with fewer than eight points in common.
[[nodiscard]] Synchrony compare(const Increments& one, const Increments& other);

}  // namespace loopscope::core::plant
