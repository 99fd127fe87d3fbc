#pragma once

#include <string_view>
#include <vector>

#include "core/hos/kernels/kernels.hpp"
#include "core/hos/transforms/spectra.hpp"

namespace loopscope::core::hos {

/// Sums over segments at every bifrequency of the principal domain, in its order: all that the
/// direct bispectrum and every normalisation of it need. X is that of the signal over
/// Spectra::scale().
struct TripleSums {
  std::vector<double> real;       ///< Re of sum X(k1) X(k2) X*(k1 + k2)
  std::vector<double> imaginary;  ///< Im of the same
  std::vector<double> power12;    ///< sum |X(k1) X(k2)|^2
};

/// Fills `sums` (resized to the domain) from `spectra`: the one hot loop of the room.
/// With the kernels of `spectra`.
void sum_triples(const Spectra& spectra, TripleSums& sums);

/// Which arithmetic this processor gets (Kernels::name). Results on different paths agree to
/// rounding, on one path to the last digit.
[[nodiscard]] inline std::string_view processor_path() {
  return best_kernels().name;
}

}  // namespace loopscope::core::hos
