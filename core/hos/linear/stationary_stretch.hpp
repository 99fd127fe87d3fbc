#pragma once

#include <cstddef>
#include <span>

namespace loopscope::core::hos {

/// A part of a record.
struct Stretch {
  std::size_t first = 0;
  std::size_t size = 0;

  bool operator==(const Stretch&) const = default;
};

/// The longest part of `signal` over which neither its mean nor the shape of its spectrum changes;
/// the whole of it where nothing speaks against that. NaN and infinity are missing.
///
/// A changed production rate gives one record two spectra. Each segment then weighs most where its
/// own spectrum does, and every average over segments looks coupled, however linear both loops are.
///
/// Looked at are the errors of the record's own linear model, which are independent in a stationary
/// linear record, whatever its spectrum: their mean and their correlations at lags 1 to 8 in
/// sub-windows of 256 samples (error_moments.hpp), each divided by its own standard deviation: a
/// variance that changes does not count, segment_levels.hpp allows for it. The record is split
/// where both sides differ most, if they differ by more than one in a thousand stationary records
/// would show and by enough to matter; either side is fitted and split in its turn, and of the
/// parts the longest counts (the later one of two). The last sub-window holds up to 511
/// samples. 128 samples on either side of a change belong to neither part.
[[nodiscard]] Stretch stationary_stretch(std::span<const double> signal);

}  // namespace loopscope::core::hos
