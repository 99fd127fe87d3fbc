#pragma once

#include <complex>
#include <cstddef>
#include <vector>

#include "core/hos/transforms/record_fft.hpp"

namespace loopscope::core::loop {

/// Smallest length of the form 2^a, 3 2^a or 5 2^a that is at least `least` (and a multiple of 4).
/// Lengths like these keep the transform at n log n; a prime such as 751 would cost n^2.
[[nodiscard]] std::size_t fast_length(std::size_t least);

/// Discrete Fourier transform of real series of one length.
///
/// forward: X(i) = sum_k x(k) exp(-2 pi j i k / m), i = 0 .. m/2. inverse undoes forward exactly.
class RealTransform {
 public:
  using Spectrum = std::vector<std::complex<double>>;  ///< m/2 + 1 values

  /// `length` as returned by fast_length.
  explicit RealTransform(std::size_t length)
      : length_(length), fft_(&hos::RecordFft::of_length(length)) {}

  [[nodiscard]] std::size_t length() const { return length_; }

  /// `series` is padded with zeros, or cut, to the length.
  [[nodiscard]] Spectrum forward(std::vector<double> series) const;
  /// length() values.
  [[nodiscard]] std::vector<double> inverse(Spectrum spectrum) const;

 private:
  std::size_t length_;
  const hos::RecordFft* fft_;
};

}  // namespace loopscope::core::loop
