#pragma once

#include <vector>

namespace loopscope::tests::network {

/// Thornhill (2005): the nonlinear prediction error of a signal against that of surrogates of the
/// same spectrum, N = (mean surrogate - own) / (3 standard deviations of the surrogates); above 1
/// is nonlinear. Neighbours of one cycle, eight of them, predicted half a cycle ahead. 0 with fewer
/// than twelve cycles.
[[nodiscard]] double thornhill_index(const std::vector<double>& signal, double period_samples);

}  // namespace loopscope::tests::network
