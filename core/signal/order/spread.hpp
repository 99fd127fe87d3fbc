#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace loopscope::core::signal {

/// Mean, standard deviation (population) and extremes of the recorded samples, in their unit.
struct Spread {
  double mean = 0.0;
  double std = 0.0;
  double low = 0.0;
  double high = 0.0;

  /// No variation beyond the rounding of the values themselves.
  [[nodiscard]] bool constant() const;
};

/// nullopt when nothing is recorded (all NaN or empty).
[[nodiscard]] std::optional<Spread> measure_spread(std::span<const double> samples);

/// Smallest distance between two different recorded values: the grid step of a quantised signal,
/// some tiny number for a continuous one. nullopt when fewer than two values differ.
[[nodiscard]] std::optional<double> smallest_step(std::span<const double> samples);

/// Smallest distance between two different values that stand next to each other: at least the
/// smallest step, and at hand without sorting. nullopt when no two neighbours differ.
[[nodiscard]] std::optional<double> smallest_neighbour_step(std::span<const double> samples);

/// Share of neighbouring recorded samples that differ, 0 to 1; 0 where there are none.
[[nodiscard]] double share_of_moves(std::span<const double> samples);

/// Longest run of identical recorded values, in samples; a missing one (NaN) ends a run.
[[nodiscard]] std::size_t longest_flat_run(std::span<const double> samples);

}  // namespace loopscope::core::signal
