#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/hos/kernels/aligned.hpp"

namespace loopscope::core::hos {

/// What a DFT of real segments padded with as many zeros needs to know; the arithmetic is in
/// segment_dft-inl.hpp, one segment per vector lane.
///
/// A real sequence x of length n has its odd bins, X(4 j + 1), in one complex DFT of length n / 4
/// (the others follow by X(n - k) = X*(k)), and its even bins in the real sequence x(i) + x(i +
/// n / 2) of half the length:
///
///     z(i) = (d(i) - i d(i + n / 4)) exp(-2 pi i i / n),  d(i) = x(i) - x(i + n / 2),  i < n / 4
///
/// so that a transform is complex DFTs of length M / 4, M / 8, ..., 1 and nothing is computed
/// twice. Each of these runs in place, radix 4 by decimation in frequency, and its last step
/// (radix 8, 4, 2 or 1) writes to the rows of the spectra, in whatever order they come.
class SegmentDft {
 public:
  /// Whether it is made for segments and DFTs of these lengths: M a power of two, 64 or more, and
  /// half of it segment.
  [[nodiscard]] static bool made_for(std::size_t segment_length, std::size_t dft_length);

  /// The tables for `dft_length`, made at their first use (plan_cache.hpp).
  [[nodiscard]] static const SegmentDft& of_length(std::size_t dft_length);

  /// made_for(dft_length / 2, dft_length), here and above; not checked.
  explicit SegmentDft(std::size_t dft_length);

  /// Cosine and sine of the angle by which a factor turns backwards.
  struct Turn {
    double cosine;
    double sine;
  };
  /// Where an output goes: the bin, and -1 where it is the conjugate of that bin, else 1.
  struct Place {
    std::size_t bin;
    double sign;
  };
  /// Steps of one complex DFT.
  struct Level {
    std::size_t length = 0;                ///< of the complex DFT: n / 4
    std::vector<Turn> input_turns;         ///< `length` of them
    std::vector<std::vector<Turn>> steps;  ///< per radix-4 step: w^i, w^2i, w^3i, i < block / 4
    std::size_t last_radix = 1;            ///< 8, 4, 2 or 1
    std::vector<Place> places;             ///< of the outputs of the last step, in their order
  };

  [[nodiscard]] std::size_t dft_length() const { return dft_length_; }
  [[nodiscard]] std::size_t segment_length() const { return dft_length_ / 2; }
  [[nodiscard]] const std::vector<Level>& levels() const { return levels_; }
  /// Doubles of working memory.
  [[nodiscard]] std::size_t scratch_size() const { return dft_length_ / 2 * 3 * kLanes; }

 private:
  std::size_t dft_length_;
  std::vector<Level> levels_;
};

/// Segments to transform at once: their mean removed, tapered, padded with zeros.
struct SegmentBatch {
  std::array<const double*, kLanes> segments;  ///< their first samples; finite
  double factor;                               ///< what every sample is multiplied by
  const double* window;                        ///< the taper
  double* scratch;                             ///< SegmentDft::scratch_size(), on a cache line
  double* rows;       ///< the real row of frequency 0 at the first of the segments, on a cache line
  std::size_t pitch;  ///< from row to row, as in SpectrumRows
};

}  // namespace loopscope::core::hos
