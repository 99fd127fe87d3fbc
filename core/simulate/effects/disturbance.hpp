#pragma once

namespace loopscope::core::simulate {

/// A sinusoid from outside the loop: A sin(2 pi t / T).
struct ExternalOscillation {
  double period_s = 100.0;  ///< T, > 0
  double amplitude = 2.0;   ///< A, pv units, >= 0
};

/// A load that moves once and stays.
struct LoadStep {
  double at_s = 2000.0;  ///< seconds after the first recorded sample, >= 0
  double size = 5.0;     ///< pv units
};

/// Throw std::invalid_argument for figures outside their ranges.
void check(const ExternalOscillation& oscillation);
void check(const LoadStep& step);

/// The disturbance at `time_s` after the first recorded sample, in pv units where it enters at the
/// process output. The oscillation runs before that sample too (negative time).
[[nodiscard]] double disturbance_at(const ExternalOscillation& oscillation, double time_s);
[[nodiscard]] double disturbance_at(const LoadStep& step, double time_s);

}  // namespace loopscope::core::simulate
