#pragma once

#include <cstddef>
#include <vector>

#include "core/hos/transforms/spectra.hpp"

namespace loopscope::core::hos {

/// How loud the signal is along the record.
///
/// Noise whose variance changes raises every bicoherence, since the loud segments weigh more in
/// each average at once. Dividing each segment's spectrum by its level removes that and leaves all
/// phases, and so all coupling, as they are.
class SegmentLevels {
 public:
  /// From the segments' power relative to its mean at each bin, over the bins clear of zero
  /// frequency; a running median over nine segments, so that single upsets do not count. Needs at
  /// least one segment.
  explicit SegmentLevels(const Spectra& spectra);

  /// The level changes by more than a long record of constant variance would show in one of a
  /// thousand; of 15 to 30 segments one or two in a hundred do, which costs nothing but the
  /// division.
  [[nodiscard]] bool vary() const { return vary_; }
  /// Segments far louder than their neighbours, by sequence number, if there are few: a load step
  /// or another single upset, on which no finding may rest. Empty where they recur, which is the
  /// loop's own way.
  [[nodiscard]] const std::vector<std::size_t>& upsets() const { return upsets_; }
  /// What the spectrum of each segment is to be multiplied by; about 1.
  [[nodiscard]] const std::vector<double>& factors() const { return factors_; }

 private:
  std::vector<double> factors_;
  std::vector<std::size_t> upsets_;
  bool vary_ = false;
};

}  // namespace loopscope::core::hos
