#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace loopscope::core::simulate {

/// `signal` with `share` (0 to below 1) of it missing (NaN) in `blocks` (>= 1) of equal length at
/// random places, which may touch but not overlap.
[[nodiscard]] std::vector<double> with_gaps(std::vector<double> signal, double share,
                                            std::size_t blocks, std::uint64_t seed);

/// `signal` (not empty) with `count` samples missing at random places (a place may be drawn twice):
/// what is left of a record after spikes were found and taken out.
[[nodiscard]] std::vector<double> with_masked_spikes(std::vector<double> signal, std::size_t count,
                                                     std::uint64_t seed);

}  // namespace loopscope::core::simulate
