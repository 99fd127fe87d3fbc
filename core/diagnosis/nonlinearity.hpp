#pragma once

#include <cstddef>
#include <string>

#include "core/hos/analyse.hpp"
#include "core/hos/settings.hpp"

namespace loopscope::core::diagnosis {

/// What the bispectrum says, for the decision.
struct NonlinearityFinding {
  bool found = false;
  double strength = 0.0;  ///< NGI in multiples of its limit; above 1 when found
  std::string reason;     ///< names NGI, NLI and the limit
};

/// NGI above which a record of K segments counts as non-Gaussian. The authors' beta belongs to
/// their K = 127; K times the mean squared bicoherence has the same distribution for every K, so
/// that the limit grows as 127 / K for shorter records. It never falls below beta.
[[nodiscard]] double ngi_limit(std::size_t segments, const hos::Settings& settings);

/// NGI first, then NLI (paper, figure 1 and section 3).
[[nodiscard]] NonlinearityFinding judge_nonlinearity(const hos::Result& hos,
                                                     const hos::Settings& settings);

}  // namespace loopscope::core::diagnosis
