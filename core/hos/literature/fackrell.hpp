#pragma once

#include <cstddef>
#include <span>

namespace loopscope::core::hos {

/// Fackrell's test ("Bispectral analysis of speech signals", thesis, University of Edinburgh 1996):
/// a bifrequency is significant when 2 K bic2 exceeds the chi-square quantile with two degrees of
/// freedom at `alpha`. What that says of a record has two readings.
struct FackrellTest {
  std::size_t exceeding = 0;  ///< significant bifrequencies
  double expected = 0.0;      ///< alpha P, what chance leaves of them
  /// Reading "some bifrequency is significant": the smallest p of all, at most alpha then. With P
  /// bifrequencies chance alone passes in 1 - (1 - alpha)^P of the records, nearly all of them.
  double smallest_p = 1.0;
  /// Reading "more are significant than chance leaves": P(Binomial(P, alpha) >= exceeding), which
  /// has its nominal level where bifrequencies are independent.
  double count_p = 1.0;
};

/// The test on squared bicoherences `bic2` (P >= 1 of them, each 0 to 1) of `segments` (K >= 2),
/// `alpha` above 0 and below 1. The null asks for independent segments: see independent_segments().
/// Throws std::invalid_argument for no values, fewer segments and any other alpha.
[[nodiscard]] FackrellTest fackrell(std::span<const double> bic2, std::size_t segments,
                                    double alpha);

}  // namespace loopscope::core::hos
