#pragma once

#include <span>
#include <vector>

namespace loopscope::core::hos {

/// A spread of no more than this many units in the last place of the largest sample is what a
/// constant shows that was computed (0.1 * 3 beside 0.3) or transformed, and no signal.
inline constexpr double kRoundingUnits = 16.0;

/// Largest magnitude among the finite samples; 0 when there is none.
[[nodiscard]] double largest_magnitude(std::span<const double> signal);

/// What one look along a record tells.
struct MagnitudeScan {
  double largest = 0.0;  ///< largest_magnitude()
  bool complete = true;  ///< no sample is missing
};

/// First sample that is not missing, 0 when all are: a constant less it leaves exact zeros,
/// whatever its length.
[[nodiscard]] double first_finite(std::span<const double> signal);

/// Mean of the samples that are not missing, and how many these are; 0 and 0 when all are.
struct FiniteMean {
  double mean = 0.0;
  double count = 0.0;
};
[[nodiscard]] FiniteMean finite_mean(std::span<const double> signal);

/// The power of two that `magnitude` (>= 0) lies above, by less than a factor of two (1 for zero).
/// Dividing by it is exact, and squares and cubes of what is left do not overflow. Held within
/// 2^-1000 to 2^1000, so that it and its reciprocal are normal numbers.
[[nodiscard]] double power_of_two_below(double magnitude);

/// `signal` over the power of two below its largest magnitude; what is missing stays missing.
[[nodiscard]] std::vector<double> scaled_to_unit(std::span<const double> signal);

}  // namespace loopscope::core::hos
