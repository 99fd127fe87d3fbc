#pragma once

#include <cstddef>

namespace loopscope::core::hos {

/// A pair of DFT bins; bin k of a DFT of length M is k / M cycles per sample.
struct Bifrequency {
  std::size_t k1 = 0;
  std::size_t k2 = 0;
  friend bool operator==(const Bifrequency&, const Bifrequency&) = default;
};

/// The bifrequencies that carry the whole (inner) bispectrum of a real signal without zero
/// frequency: 1 <= k2 <= k1 and k1 + k2 <= M / 2 for a DFT of even length M. Everything else in
/// the plane follows by symmetry (Rosenblatt and Van Ness 1965).
///
/// Values over the domain are stored row by row, k2 = 1, 2, ..., and within a row k1 = k2,
/// k2 + 1, ..., M / 2 - k2.
class PrincipalDomain {
 public:
  explicit PrincipalDomain(std::size_t dft_length) : half_(dft_length / 2) {}

  /// L: (M / 4)^2 for M divisible by four; 1024 for the paper's M = 128.
  [[nodiscard]] std::size_t size() const { return row_begin(rows() + 1); }
  /// Largest k2.
  [[nodiscard]] std::size_t rows() const { return half_ / 2; }
  /// Number of k1 that go with a k2.
  [[nodiscard]] std::size_t row_size(std::size_t k2) const { return half_ + 1 - 2 * k2; }
  /// Position of (k2, k2).
  [[nodiscard]] std::size_t row_begin(std::size_t k2) const { return (k2 - 1) * (half_ + 1 - k2); }

  [[nodiscard]] bool contains(Bifrequency at) const {
    return at.k2 >= 1 && at.k2 <= at.k1 && at.k1 + at.k2 <= half_;
  }
  /// Position of a bifrequency that the domain contains.
  [[nodiscard]] std::size_t index(Bifrequency at) const {
    return row_begin(at.k2) + (at.k1 - at.k2);
  }
  /// Inverse of index(), for positions below size().
  [[nodiscard]] Bifrequency at(std::size_t index) const;

 private:
  std::size_t half_;  // M / 2
};

}  // namespace loopscope::core::hos
