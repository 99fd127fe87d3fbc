#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "core/plant/member_loop.hpp"

namespace loopscope::core::plant::tests {

/// How an oscillator's phase and amplitude wander, sample by sample.
struct Course {
  std::vector<double> phase;      ///< radians
  std::vector<double> amplitude;  ///< positive
};

/// `wander` = standard deviation of the phase's step over one period, radians; 0 = a perfect line.
[[nodiscard]] Course draw_course(std::size_t samples, double period, double increments,
                                 std::mt19937_64& random);

/// One loop's error: the course `lag` samples late at the given period (samples), with coloured
/// noise of that standard deviation; amplitude 1.
[[nodiscard]] std::vector<double> draw_error(const Course& course, double period, std::size_t lag,
                                             double noise, std::size_t samples,
                                             std::mt19937_64& random);

/// A loop that is sampled every second. `error` has to outlive it.
[[nodiscard]] MemberLoop oscillating_loop(std::int64_t id, const std::vector<double>& error);

/// Windows of loops that oscillate, each in its own noise.
struct OscillatingPlant {
  std::vector<std::vector<double>> errors;
  std::vector<int> groups;        ///< of the shared oscillation; -1 = none
  std::vector<MemberLoop> loops;  ///< once finished

  /// A loop that follows the course at most a period late.
  void add(const Course& course, double period, std::mt19937_64& random, int group = -1);
  /// Once all are in: views do not survive a vector that grows.
  const std::vector<MemberLoop>& finish();
};

[[nodiscard]] double uniform(double low, double high, std::mt19937_64& random);

}  // namespace loopscope::core::plant::tests
