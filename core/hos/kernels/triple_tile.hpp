#pragma once

#include <cstddef>

namespace loopscope::core::hos {

/// Spectra of a batch of segments as Spectra keeps them: for every frequency a real, an imaginary
/// and a power row over segments, padded with zeros.
struct SpectrumRows {
  const double* first;     ///< the real row of frequency 0, on a cache line
  std::size_t row_length;  ///< doubles, a multiple of kLanes
  std::size_t pitch;       ///< doubles from row to row, a multiple of kLanes
  std::size_t dft_length;  ///< M, even; frequencies 0 .. M / 2 and kZeroFrequencies of zeros above

  [[nodiscard]] std::size_t stride() const { return kRows * pitch; }
  [[nodiscard]] const double* real(std::size_t k) const { return first + k * stride(); }

  static constexpr std::size_t kRows = 3;
  /// Frequencies above M / 2 that are read as well and hold zeros, so that a tile of bifrequencies
  /// may stick out of the domain.
  static constexpr std::size_t kZeroFrequencies = 4;
};

/// Where the sums over segments go: one double per bifrequency, in the order of PrincipalDomain.
/// What the sums are is said at TripleSums.
struct TripleOutputs {
  double* real;
  double* imaginary;
  double* power12;
};

}  // namespace loopscope::core::hos
