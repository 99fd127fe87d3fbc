#pragma once

#include <span>
#include <string_view>

#include "core/hos/kernels/record_sums.hpp"
#include "core/hos/kernels/segment_dft.hpp"
#include "core/hos/kernels/triple_tile.hpp"
#include "core/hos/numeric/magnitude.hpp"

namespace loopscope::core::hos {

/// Rows of one length, one after another at a fixed distance.
struct Rows {
  const double* first;  ///< on a cache line
  std::size_t stride;   ///< doubles from row to row, a multiple of kLanes
  std::size_t length;   ///< doubles, a multiple of kLanes
  std::size_t count;
};

/// Every hot loop of the room, compiled for one kind of processor. Fused multiply-adds round once
/// and lanes change the order of sums, so that results of different kernels differ by rounding; one
/// kernel gives the same digits whatever was computed before and in any number of threads.
struct Kernels {
  std::string_view name;  ///< "avx512", "avx2", "sse4", "neon", or "portable": the compiler's own
  /// largest_magnitude() and whether every sample is finite, in one look.
  MagnitudeScan (*scan)(std::span<const double> signal);
  /// The spectra of kLanes segments; `dft` must be made for their length.
  void (*transform)(const SegmentDft& dft, const SegmentBatch& batch);
  /// Sum of every row, `sums[0 .. count - 1]`.
  void (*sum_rows)(const Rows& rows, double* sums);
  /// Every bifrequency of the principal domain.
  void (*sum_triples)(const SpectrumRows& rows, const TripleOutputs& sums);
  /// Squared bicoherence of every bifrequency from these sums and the power of all bins; 0 where
  /// the denominator is not above zero. Says whether any is. Here the digits are the same on every
  /// kind of processor, as those of the two below.
  bool (*normalise)(const TripleOutputs& sums, const double* total_power, std::size_t dft_length,
                    double* bic2);
  ValueTotals (*sum_values)(std::span<const double> values);
  double (*sum_square_deviations)(std::span<const double> values, double mean);
  /// Over the finite samples.
  PowerSums (*sum_powers)(std::span<const double> signal, const Centring& centring);
  TrendSums (*sum_trend)(std::span<const double> signal, const Centring& centring);
  /// (y - centre - slope t) 0.5 (1 - cos(2 pi (n + 0.5) / count)), 0 where a sample is missing;
  /// `tapered` as long as `signal`.
  void (*taper_record)(std::span<const double> signal, const Centring& centring, double* tapered);
  /// Of each difference of neighbours (f) and the one before it (b), where both are finite.
  PairSums (*sum_differences)(std::span<const double> signal);
  /// Of two series of `count` finite values.
  PairSums (*sum_pairs)(const double* f, const double* b, std::size_t count);
  /// Replaces f by f - k b, and b by b - k f.
  void (*predict_each_other)(double* f, double* b, std::size_t count, double k);
  /// x(n) - a_1 x(n - 1) - ... - a_p x(n - p) for n = 0 .. count - 1; x(-p) must be readable.
  void (*subtract_predictions)(const double* x, std::size_t count, std::span<const double> a,
                               double* errors);
  /// sums[l] = sum over n of weighted(n) x(n - l), l = 0 .. sums.size() - 1; x(-l) must be
  /// readable.
  void (*sum_lags)(std::span<const double> weighted, const double* x, std::span<double> sums);
  /// Dot product of each column with the samples from x on, into kColumns outputs.
  void (*apply_taps)(const FilterTaps& taps, const double* x, double* outputs);
  /// Rows times weights, added up; `sums` as long as a row.
  void (*weigh_rows)(const Rows& rows, const double* weights, double* sums);
};

/// The fastest that this processor can run.
[[nodiscard]] const Kernels& best_kernels();

}  // namespace loopscope::core::hos
