#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/hos/transforms/settings.hpp"

namespace loopscope::core::hos {

/// Samples from the start of one segment to the start of the next, >= 1.
[[nodiscard]] std::size_t segment_hop(const Settings& settings);

/// First samples of the segments of `signal` that hold finite samples only.
///
/// Segments lie on a fixed grid (0, hop, 2 hop, ...), whatever is missing: dropping those that
/// touch a gap leaves the others, and so the null of the estimate, as they were. Nothing is
/// interpolated, since every interpolation couples frequencies.
[[nodiscard]] std::vector<std::size_t> segment_starts(std::span<const double> signal,
                                                      const Settings& settings);

/// The same as places on the grid, in hops, into `positions`: no memory is taken once that has been
/// as long. `complete` says that no sample is missing, so that none has to be looked at.
void find_segments(std::span<const double> signal, bool complete, const Settings& settings,
                   std::vector<std::size_t>& positions);

}  // namespace loopscope::core::hos
