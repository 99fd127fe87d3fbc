#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/simulate/innovations.hpp"

namespace loopscope::core::simulate {

/// Shape of one cycle; each has mean 0 and variance 1.
enum class WaveShape {
  sine,
  square,             ///< odd harmonics only
  triangle,           ///< odd harmonics only
  sawtooth,           ///< all harmonics, odd about its centre
  asymmetric_square,  ///< high for 0.3 of the cycle: all harmonics
};
[[nodiscard]] std::string_view name(WaveShape shape);

/// A periodic wave in white noise, as the control error of a loop that cycles.
struct LimitCycle {
  WaveShape shape = WaveShape::square;
  double period_samples = 64.0;  ///< above 2
  double snr_db = 10.0;          ///< 10 log10 of the wave's variance over the noise's
  /// Standard deviation that the phase gains over one cycle, radians, as a random walk (so it grows
  /// with the root of the cycles). 0.1 keeps the period within about 2 % from cycle to cycle; 0 is
  /// a strict line.
  double jitter_rad = 0.1;
  Innovation noise = Innovation::gaussian;
};

/// `samples` of the wave (variance 1, start anywhere in the cycle) and its noise.
[[nodiscard]] std::vector<double> limit_cycle(const LimitCycle& cycle, std::size_t samples,
                                              std::uint64_t seed);

}  // namespace loopscope::core::simulate
