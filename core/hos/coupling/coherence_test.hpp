#pragma once

#include <complex>
#include <cstddef>
#include <span>

namespace loopscope::core::hos {

/// Two complex sequences over segments: are they coherent? The first three spans have length K.
struct CoherencePair {
  std::span<const std::complex<double>> products;  ///< w: what the values should follow, K of them
  std::span<const std::complex<double>> values;    ///< x: the spectrum at the sum frequency
  std::span<const std::size_t> positions;          ///< of the segments, in hops, increasing
  /// E[x_s x*_{s+d}] / E|x_s|^2 of noise, d = 0 .. lags; the first is 1.
  std::span<const std::complex<double>> correlation;
};

/// -ln p of the hypothesis that x is complex Gaussian noise of a spectrum that is flat over a main
/// lobe, whatever w is: the test is made given w, so that neither the loop's spectrum nor the heavy
/// tails of products of spectra enter it. >= 0; 0 where there are too few segments to say anything.
///
/// With N = sum w* x: var N = v sigma^2 sum |w|^2, v = w^H R w / w^H w, R the correlation above;
/// the power <|x|^2> has the freedom of J = K^2 / sum |R|^2 independent segments. So
///     b = |N|^2 / (sum |w|^2 sum |x|^2),   p = (1 - b K / (v J))^(J - 1),
/// which is exact (a beta distribution) when segments do not overlap. Never throws.
[[nodiscard]] double coherence_evidence(const CoherencePair& pair);

}  // namespace loopscope::core::hos
