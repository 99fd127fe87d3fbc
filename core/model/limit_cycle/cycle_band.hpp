#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/model/limit_cycle/kernels/cycle_kernel.hpp"
#include "core/model/vectors/eight_numbers.hpp"

namespace loopscope::core::model {

/// The band of frequencies of one limit cycle: samples are averaged until a cycle has 20 to 40 of
/// them (shorter cycles as recorded), and what is slower than 2.5 cycles (drift) or faster than a
/// tenth of one (noise) is taken out. Both are linear, so that a model's output and pv may be
/// treated alike and then compared: the drift needs no parameters. No series may hold NaN.
class CycleBand {
 public:
  /// `period_samples` of the recording, >= 2.
  explicit CycleBand(double period_samples);

  [[nodiscard]] std::size_t factor() const { return factor_; }  ///< samples averaged to one
  [[nodiscard]] double period() const { return period_; }       ///< in kept samples

  /// Means of `factor` samples; a rest at the end is dropped.
  [[nodiscard]] std::vector<double> resample(std::span<const double> samples) const;
  [[nodiscard]] std::vector<EightNumbers> resample(std::span<const EightNumbers> samples) const;
  /// A short mean less a long one around every kept sample; same length.
  [[nodiscard]] std::vector<double> pass(std::span<const double> kept) const;
  /// The same of eight series, by the sums of all before each sample, and of all: one more than
  /// samples.
  [[nodiscard]] std::vector<EightNumbers> pass_sums(std::span<const EightNumbers> sums) const;
  /// The half widths of the two means.
  [[nodiscard]] BandWidths widths() const { return {long_half_, short_half_}; }
  /// The long mean alone: the drift that pass() takes out.
  [[nodiscard]] std::vector<double> drift(std::span<const double> kept) const;

 private:
  std::size_t factor_;
  double period_;
  std::size_t long_half_;  ///< kept samples to either side
  std::size_t short_half_;
};

/// Periods, in samples, at which a limit cycle may run: that with most power in the error, and that
/// at which op turns back by a good part of its travel, where they differ. The spectrum misses
/// cycles of which fewer than nine are recorded, and cycles whose harmonics or noise stand out more
/// than they do; op's large turns miss cycles on a drift. Neither series has holes; at least one.
[[nodiscard]] std::vector<double> candidate_periods(std::span<const double> error,
                                                    std::span<const double> op);

}  // namespace loopscope::core::model
