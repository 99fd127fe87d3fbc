#pragma once

#include <optional>
#include <span>

namespace loopscope::core::loop {

/// Oscillation of a signal from the zero crossings of its autocorrelation
/// (Thornhill, Huang and Zhang 2003), read in the octaves around the most powerful spectral peak.
struct Oscillation {
  /// The spectrum has a clear peak, r is above min_regularity, the autocorrelation comes back after
  /// one period, and the window holds min_cycles. The other figures describe the best candidate and
  /// are scores: filtered noise alone has r about 1.
  bool present = false;
  std::optional<double> period_s;  ///< twice the mean interval between zero crossings, seconds
  /// r = mean / (3 std) of the first ten intervals; > 1 is regular. At most 100.
  std::optional<double> regularity;
  std::optional<double> amplitude;  ///< sqrt(2 variance at the period), signal units
  /// Height of the autocorrelation peaks: ratio of the fourth to the first (0 to 1). Near 1 for
  /// a sustained line (limit cycle, outside sinusoid), small for a noise-driven resonance. Below
  /// eight cycles in the window it is carried on from the peaks that the lags hold; nullopt below
  /// four.
  std::optional<double> persistence;
  /// Probability that a record without an oscillation (smooth spectrum: noise, drift, a well damped
  /// loop) is called oscillating on evidence as strong as this (oscillation_p.hpp). 1 when none is
  /// present, so that every measured record has one; nullopt when nothing was measured.
  std::optional<double> p = std::nullopt;
};

/// Settings of the search.
struct OscillationSettings {
  double min_regularity = 1.0;           ///< r above which an oscillation is present
  double min_half_period_samples = 4.0;  ///< shorter half periods are noise
  double min_cycles = 5.0;               ///< cycles that the window has to hold
};

/// `signal` may hold NaN for missing samples; its mean and drift are removed. All figures are
/// nullopt where the signal has fewer than 32 recorded samples, no variance or too few zero
/// crossings (p is 1 in the last case). `sample_interval_s` > 0.
[[nodiscard]] Oscillation find_oscillation(std::span<const double> signal, double sample_interval_s,
                                           const OscillationSettings& settings = {});

}  // namespace loopscope::core::loop
