#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/hos/kernels/aligned.hpp"
#include "core/hos/kernels/kernels.hpp"
#include "core/hos/transforms/paired_spectra.hpp"
#include "core/hos/transforms/settings.hpp"

namespace loopscope::core::hos {

/// Windowed spectra of all complete segments of a signal, each segment's own mean removed.
///
/// Made once per settings and used for many signals; no call after the first of a length
/// allocates. Layout: three rows per frequency (real, imaginary,
/// power), each over all segments and padded with zeros to whole cache lines, so that an average
/// over segments of any product of spectra is a dot product with unit stride and without a
/// remainder.
///
/// The signal is divided by the power of two below its largest magnitude first. That is exact,
/// changes no ratio of spectra, and keeps the products of six of them away from overflow.
class Spectra {
 public:
  /// Throws std::invalid_argument for settings out of range.
  explicit Spectra(const Settings& settings, const Kernels& kernels = best_kernels());

  /// Replaces the spectra by those of `signal`; NaN and infinity are missing samples.
  void compute(std::span<const double> signal);

  /// Multiplies the spectrum of segment s by factors[s] (> 0, near 1), s = 0 .. segments() - 1.
  void scale_segments(std::span<const double> factors);

  /// K: segments without a missing sample; 0 for a signal shorter than one.
  [[nodiscard]] std::size_t segments() const { return segments_; }
  /// Where each of them lies on the grid of segments, in hops from the start.
  [[nodiscard]] const std::vector<std::size_t>& positions() const { return positions_; }
  /// Length of a row: K rounded up to whole cache lines.
  [[nodiscard]] std::size_t row_length() const { return row_length_; }
  /// Frequency bins 0 .. frequencies() - 1, that is dft_length / 2 + 1 of them.
  [[nodiscard]] std::size_t frequencies() const { return settings_.dft_length / 2 + 1; }
  /// Bins above those that may be read as well and hold zeros.
  static constexpr std::size_t kZeroFrequencies = SpectrumRows::kZeroFrequencies;

  /// Rows of bin k, row_length() doubles: Re X, Im X and |X|^2 of the signal over scale().
  [[nodiscard]] const double* real(std::size_t k) const { return row(k, 0); }
  [[nodiscard]] const double* imaginary(std::size_t k) const { return row(k, 1); }
  [[nodiscard]] const double* power(std::size_t k) const { return row(k, 2); }
  /// Sum of the power of bin k over all segments; 0 where it is no more than rounding noise.
  [[nodiscard]] double total_power(std::size_t k) const { return total_power_[k]; }
  /// Of all bins, frequencies() of them.
  [[nodiscard]] const double* total_power() const { return total_power_.data(); }

  /// Sum over segments of the real (0), imaginary (1) or power (2) row of every bin.
  [[nodiscard]] std::vector<double> sums(std::size_t which) const;

  /// All of that, for the kernels.
  [[nodiscard]] SpectrumRows rows() const {
    return {rows_.data(), row_length_, pitch_, settings_.dft_length};
  }
  [[nodiscard]] const Kernels& kernels() const { return *kernels_; }

  /// What the signal was divided by, in its unit; a power of two.
  [[nodiscard]] double scale() const { return scale_; }
  [[nodiscard]] const std::vector<double>& window() const { return window_; }
  [[nodiscard]] const Settings& settings() const { return settings_; }

 private:
  static constexpr std::size_t kRows = SpectrumRows::kRows;

  [[nodiscard]] const double* row(std::size_t k, std::size_t which) const {
    return rows_.data() + (k * kRows + which) * pitch_;
  }
  void resize_rows(std::size_t row_length);
  void transform_batch(std::span<const double> signal, std::size_t first);
  void sum_power() { sum_rows(2, total_power_.data()); }
  void sum_rows(std::size_t which, double* sums) const;
  /// Power over all segments up to which a bin holds rounding noise only.
  [[nodiscard]] double power_floor(double largest) const;

  Settings settings_;
  const Kernels* kernels_;
  std::vector<double> window_;
  double window_sum_;
  const SegmentDft* dft_;                // nullptr where it is not made for the lengths
  std::optional<PairedSpectra> paired_;  // then this
  std::vector<double> silence_;          // a segment of zeros
  AlignedVector scratch_;
  AlignedVector rows_;
  std::vector<double> total_power_;
  std::vector<std::size_t> positions_;
  std::size_t segments_ = 0;
  std::size_t row_length_ = 0;
  std::size_t pitch_ = 0;  // doubles from row to row
  double scale_ = 1.0;
};

}  // namespace loopscope::core::hos
