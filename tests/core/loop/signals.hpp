#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

/// Known signals for the tests of core/loop; one seed, one signal.
namespace loopscope::core::loop::signals {

using Series = std::vector<double>;
using Random = std::mt19937_64;

enum class Wave { sine, square, triangle };

Series white(Random& random, std::size_t count);
/// x(k) = phi x(k-1) + white, started in its stationary state (phi < 1) or at 0 (phi = 1).
Series ar1(Random& random, std::size_t count, double phi);
/// Resonance with poles damping * exp(+-2 pi j / period).
Series resonance(Random& random, std::size_t count, double period, double damping);
/// Amplitude 1, random phase; the phase wanders by `jitter` radians per radian^(1/2).
Series wave(Random& random, std::size_t count, Wave kind, double period, double jitter = 0.0);
/// Adds `scale` times `other`.
Series sum(Series series, const Series& other, double scale);
/// `noise` scaled to the signal-to-noise ratio in dB of variances, added.
Series at_snr(const Series& series, const Series& noise, double snr_db);
/// Each sample goes missing with the probability.
Series with_missing(Random& random, Series series, double probability);

/// The loop of the paper's section 5 (equation 20 under PI control): pv, op and valve position.
struct SimulatedLoop {
  Series pv, op, mv;
};

struct LoopSettings {
  double gain = 0.15;               ///< Kc
  double integral = 0.15;           ///< I, per sample
  double stickband = 0.0;           ///< S, % of op
  double slip_jump = 0.0;           ///< J, % of op
  double sinusoid_amplitude = 0.0;  ///< of the outside disturbance with frequency 0.01
  double walk_std = 0.0;            ///< of the steps of the integrated disturbance
  double setpoint_step = 0.0;       ///< at the start, as a limit cycle needs one
};

/// The last `count` of `count` + 1500 samples.
SimulatedLoop simulate(Random& random, std::size_t count, const LoopSettings& settings);

/// Valve of stickband `s` and slip jump `j` (He, Wang, Pottmann and Qin 2007); j = 0: dead band s.
Series through_valve(const Series& op, double s, double j);

}  // namespace loopscope::core::loop::signals
