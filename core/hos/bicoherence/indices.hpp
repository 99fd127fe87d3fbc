#pragma once

#include <cstddef>
#include <span>

#include "core/hos/kernels/kernels.hpp"

namespace loopscope::core::hos {

/// The paper's indices of one squared bicoherence.
struct Indices {
  double mean_bic2 = 0.0;
  double std_bic2 = 0.0;  ///< population standard deviation over the domain
  double max_bic2 = 0.0;
  double critical_mean_bic2 = 0.0;  ///< (c + sqrt(4L - 1))^2 / (4KL), eq. 11
  double ngi = 0.0;                 ///< mean - critical mean, eq. 12
  double nli = 0.0;                 ///< |max - (mean + 2 std)|, eq. 14
};

/// Mean squared bicoherence that a Gaussian signal exceeds with probability `alpha` (above 0, below
/// 1) if the `bifrequencies` (L >= 1) values are independent, with `segments` (K >= 1) averages:
/// eq. 9 to 11.
[[nodiscard]] double critical_mean_bic2(std::size_t segments, std::size_t bifrequencies,
                                        double alpha);

/// Indices of the values `bic2` (not empty, each 0 to 1) over a principal domain; the rest as
/// above.
[[nodiscard]] Indices indices(std::span<const double> bic2, std::size_t segments, double alpha,
                              const Kernels& kernels = best_kernels());

}  // namespace loopscope::core::hos
