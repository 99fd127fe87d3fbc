#pragma once

#include <cstddef>

#include "core/hos/linear/innovations.hpp"

namespace loopscope::core::hos {

/// How the innovations of a record differ from normal noise of one loudness, which a linear loop
/// passes on and no test of coupling may call nonlinear. Every p is against normal noise.
struct NoiseShape {
  double excess_kurtosis = 0.0;  ///< of the innovations over their local scale; 0 = normal
  double tails_p = 1.0;          ///< heavier tails: their kurtosis, after Anscombe and Glynn (1983)
  double light_tails_p = 1.0;    ///< lighter ones, as of uniform noise
  double skewness_p = 1.0;       ///< two-sided
  double variance_p = 1.0;       ///< loudness that changes: see noise_shape()
  /// The loudest stretch where it changes, samples of the record; size 0 = none is louder than
  /// one and a half times the usual.
  std::size_t loudest_first = 0;
  std::size_t loudest_size = 0;
  double loudest_ratio = 1.0;  ///< mean magnitude there over the median of all blocks
};

/// Heavy tails are judged on the innovations over their local scale, so that bursts are not taken
/// for them. Changes of loudness are judged on the magnitudes, clipped at 3.5 robust standard
/// deviations, so that tails are not: means over blocks of 16, 64 and 256 scatter more than those
/// of independent values (chi squared, Bonferroni over the three). With fewer than
/// LinearModel::kFewestResiduals known innovations every p is 1.
[[nodiscard]] NoiseShape noise_shape(const Innovations& innovations,
                                     const Kernels& kernels = best_kernels());

}  // namespace loopscope::core::hos
