#pragma once

#include <complex>
#include <vector>

#include "core/model/controller/sampled_process.hpp"

namespace loopscope::core::model {

/// Zeros in z of a polynomial in z^-1 (its constant not 0), those at z = 0 left out: eigenvalues of
/// its companion matrix. Empty for a constant.
[[nodiscard]] std::vector<std::complex<double>> zeros(const Polynomial& polynomial);

}  // namespace loopscope::core::model
