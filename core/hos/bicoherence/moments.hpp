#pragma once

#include <span>

#include "core/hos/kernels/kernels.hpp"

namespace loopscope::core::hos {

/// Standardised moments of the finite samples of a record.
struct Moments {
  double skewness = 0.0;         ///< m3 / m2^1.5, central moments with divisor N
  double excess_kurtosis = 0.0;  ///< m4 / m2^2 - 3; 0 for Gaussian samples, at least -2
};

/// Zeros when no sample is finite or all are equal up to rounding. Missing samples are NaN or
/// infinity.
[[nodiscard]] Moments moments(std::span<const double> signal,
                              const Kernels& kernels = best_kernels());

}  // namespace loopscope::core::hos
