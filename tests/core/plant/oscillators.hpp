#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "core/plant/member_loop.hpp"

namespace loopscope::core::plant::testing {

/// How an oscillator's phase and amplitude wander, sample by sample.
struct Course {
  std::vector<double> phase;      ///< radians
  std::vector<double> amplitude;  ///< positive
};

/// `wander` = standard deviation of the phase's step over one period, radians; 0 = a perfect line.
[[nodiscard]] Course draw_course(std::size_t samples, double period, double wander,
                                 std::mt19937_64& random);

/// One loop's error: the course `lag` samples late at the given period (samples), with coloured
/// noise of that standard deviation; amplitude 1.
[[nodiscard]] std::vector<double> draw_error(const Course& course, double period, std::size_t lag,
                                             double noise, std::size_t samples,
                                             std::mt19937_64& random);

/// A loop that shows an oscillation of this period (samples of one second). `error` has to outlive
/// it.
[[nodiscard]] MemberLoop oscillating_loop(std::int64_t id, const std::vector<double>& error,
                                          double period);

[[nodiscard]] double uniform(double low, double high, std::mt19937_64& random);

}  // namespace loopscope::core::plant::testing
