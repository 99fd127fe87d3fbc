#pragma once

#include <span>
#include <vector>

namespace loopscope::core::plant {

/// How the tests of different loops may hang together.
enum class Dependence {
  positive,   ///< independent, or rising together (shared noise): Benjamini and Hochberg 1995
  arbitrary,  ///< in any way: Benjamini and Yekutieli 2001; costs a factor of about ln m
};

/// What is flagged of one family of tests.
struct FalseDiscovery {
  double threshold = 0.0;     ///< largest p-value that is flagged; NaN when none is
  std::vector<bool> flagged;  ///< one per p-value, in their order
};

/// Flags the p-values up to the largest p(i) <= rate * i / (m c), p(1) <= ... <= p(m) the sorted
/// ones: of the flags, the expected share that is false is at most `rate` times the share of the
/// tests whose null holds (Benjamini and Hochberg 1995, theorem 1; Benjamini and Yekutieli 2001,
/// theorems 1.2 and 1.3). c is 1, or 1 + 1/2 + ... + 1/m under arbitrary dependence.
///
/// NaN marks a test that was not made: it does not count to m and is not flagged. A test that was
/// made and may not be flagged, for whatever reason, belongs in here with p = 1, not left out.
/// Throws std::invalid_argument for a p outside 0 to 1 and a rate outside 0 to 1.
[[nodiscard]] FalseDiscovery control_false_discovery(std::span<const double> p, double rate,
                                                     Dependence dependence = Dependence::positive);

}  // namespace loopscope::core::plant
