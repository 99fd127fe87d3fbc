#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/model/vectors/eight_numbers.hpp"

namespace loopscope::core::model {

/// Half widths of the two means of a CycleBand, kept samples.
struct BandWidths {
  std::size_t long_half = 0;
  std::size_t short_half = 0;
};

/// x(k) = pole x(k-1) + share u(k).
struct LagStep {
  double pole = 0.0;
  double share = 1.0;
  bool at_rest = false;  ///< starts at 0; else at its first input
};

/// Over the samples of one fold, for each series.
struct FoldSums {
  EightNumbers cross;   ///< of response and pv
  EightNumbers square;  ///< of the response
};

/// What responses are compared with.
struct WeighedPv {
  std::span<const double> weighted;  ///< pv times its weight
  std::span<const double> weights;   ///< 0 or 1
  std::size_t block = 1;             ///< so many samples go to the two folds by turns
};

/// What the judge of limit cycles does along records, for one kind of processor; all kinds give the
/// same results, to the last digit. Series that go side by side have kSideBySide numbers a sample,
/// others one: their `stride`.
struct CycleKernel {
  /// kept: means of `factor` samples; a rest at the end is dropped.
  void (*resample)(std::span<const double> samples, std::size_t stride, std::size_t factor,
                   double* kept);
  /// sums[i][k]: of the responses of lag i to the inputs less their mean, before sample k; one row
  /// more than inputs.
  void (*respond)(std::span<const EightNumbers> inputs, std::span<const LagStep> lags,
                  EightNumbers* const* sums);
  /// passed: the short mean less the long one, of series given by `sums` as respond() has them.
  void (*pass)(BandWidths widths, std::span<const double> sums, std::size_t stride, double* passed);
  /// folds[i]: of the responses that pass() makes of `sums`, one row more than pv, delays[i] later.
  void (*multiply)(BandWidths widths, std::span<const EightNumbers> sums,
                   std::span<const std::size_t> delays, const WeighedPv& pv,
                   std::array<FoldSums, 2>* folds);
};

/// The fastest that this processor can run.
[[nodiscard]] const CycleKernel& best_cycle_kernel();

}  // namespace loopscope::core::model
