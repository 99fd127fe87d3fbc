#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/model/valve_law/op_turns.hpp"

namespace loopscope::core::model {

/// The mean half cycle between two turns of op, falling ones turned over.
struct MeanHalfCycle {
  /// Share of the signal's square that the mean half cycle explains: near 1 for a steady wave,
  /// about a half for noise, whose turns line up with themselves.
  double coherence = 0.0;
  /// Third harmonic over the fundamental in the fundamental's phase: -1/9 triangle, 0 sine, 1/3
  /// square, whatever the shift against op.
  double third_harmonic = 0.0;
};

/// `signal` in the band of the cycle, sampled as op was when the turns were found. nullopt with
/// fewer than four half cycles of at least three samples.
[[nodiscard]] std::optional<MeanHalfCycle> mean_half_cycle(std::span<const double> signal,
                                                           std::span<const OpTurn> turns);

/// Places of zero crossings, in samples, between excursions beyond 0.15 of the root mean square:
/// noise near zero crosses often, and counts as one.
[[nodiscard]] std::vector<double> crossings_of(std::span<const double> signal);

/// He, Wang, Pottmann and Qin (2007) on the half cycles between zero crossings of a signal in the
/// band: mean of MSE_sine / (MSE_sine + MSE_triangle), 0 = sine, 1 = triangle. `period` in samples
/// of the signal; crossings within noise of zero are one. nullopt with fewer than four half cycles.
[[nodiscard]] std::optional<double> triangle_share(std::span<const double> signal, double period);

}  // namespace loopscope::core::model
