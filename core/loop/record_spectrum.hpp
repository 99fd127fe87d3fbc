#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/loop/real_transform.hpp"
#include "core/signal/loop_window.hpp"
#include "core/signal/order/spread.hpp"

namespace loopscope::core::loop {

/// Frequencies that are kept, cycles per sample; high may exceed 0.5 (nothing is cut above).
struct Band {
  double low = 0.0;
  double high = 0.5;
};

/// Length of the transforms of a record of `samples`: half as much again leaves room for lags up
/// to half of the record and for the fade of RecordSpectrum.
[[nodiscard]] std::size_t transform_length(std::size_t samples);

/// Spectrum of one record, from which bands can be cut without the ends or the gaps ringing.
///
/// Gaps are bridged by straight lines, mean and slope removed, and the record is continued by its
/// own mirror images, faded into each other, so that it closes on itself without a step: a drifting
/// record would otherwise leak its jump from end to start into every band.
class RecordSpectrum {
 public:
  /// `signal` may hold NaN; `spread` is its spread, which is not constant(). `transform` has
  /// transform_length(signal.size()) and outlives this object.
  RecordSpectrum(std::span<const double> signal, const signal::Spread& spread,
                 RealTransform& transform);

  /// |X|^2 per bin of the record scaled to unit variance; bin i stands for bin_width() * i.
  [[nodiscard]] const std::vector<double>& power() const { return power_; }
  /// Cycles per sample between bins.
  [[nodiscard]] double bin_width() const;
  /// Independent spectral estimates per bin (< 1: the continued record is longer than the data).
  [[nodiscard]] double independent_share() const;

  /// The part of the signal within `band` (flanks of 10 % on the inside), in signal units. Missing
  /// where a gap is longer than `longest_bridge` samples.
  [[nodiscard]] signal::Samples component(Band band, std::size_t longest_bridge);

 private:
  signal::Samples recorded_;
  RealTransform& transform_;
  double scale_ = 1.0;
  RealTransform::Spectrum spectrum_;
  std::vector<double> power_;
};

}  // namespace loopscope::core::loop
