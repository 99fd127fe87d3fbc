#pragma once

#include <span>
#include <vector>

namespace loopscope::core::plant {

/// Which loops make the list: the most probable faults first, as long as the mean of 1 -
/// probability over the list is at most `share`, which is then the expected share of loops without
/// a fault on it (Newton, Noueiry, Sarkar, Ahlquist 2004; Mueller, Parmigiani, Rice 2007: of all
/// lists with that share it is the longest), and down to a probability of `least`: behind many sure
/// faults the mean alone would take in what is hardly more likely a fault than not. PvPlateaus on
/// probabilities that hold, on nothing else: loops may hang together in any way. Equal
/// probabilities are listed together or not at all. NaN = not weighed: not listed. @throws
/// std::invalid_argument a probability, the share or `least` is not from 0 to 1.
[[nodiscard]] std::vector<bool> list_by_odds(std::span<const double> fault_probability,
                                             double share, double least);

}  // namespace loopscope::core::plant
