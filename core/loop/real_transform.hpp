#pragma once

#include <complex>
#include <cstddef>
#include <unsupported/Eigen/FFT>
#include <vector>

namespace loopscope::core::loop {

/// Smallest length of the form 2^a, 3 2^a or 5 2^a that is at least `least` (and a multiple of 4).
/// Lengths like these keep the transform at n log n; a prime such as 751 would cost n^2.
[[nodiscard]] std::size_t fast_length(std::size_t least);

/// Discrete Fourier transform of real series of one length, keeping its twiddle factors.
///
/// forward: X(i) = sum_k x(k) exp(-2 pi j i k / m), i = 0 .. m/2. inverse undoes forward exactly.
class RealTransform {
 public:
  using Spectrum = std::vector<std::complex<double>>;  ///< m/2 + 1 values

  /// `length` as returned by fast_length.
  explicit RealTransform(std::size_t length) : length_(length) {
    fft_.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  }

  [[nodiscard]] std::size_t length() const { return length_; }

  /// `series` is padded with zeros to the length.
  [[nodiscard]] Spectrum forward(std::vector<double> series);
  [[nodiscard]] std::vector<double> inverse(const Spectrum& spectrum);

 private:
  std::size_t length_;
  Eigen::FFT<double> fft_;
};

}  // namespace loopscope::core::loop
