#pragma once

#include <span>
#include <vector>

namespace loopscope::core::plant {

/// Which loops make the list: the most probable faults first, as long as the mean of 1 -
/// probability over the list is at most `share`, which is then the expected share of loops without
/// a fault on it (Newton, Noueiry, Sarkar, Ahlquist 2004; Mueller, Parmigiani, Rice 2007: of all
/// lists with that share it is the longest). Rests on probabilities that hold, on nothing else:
/// loops may hang together in any way. What is more likely no fault than one is not listed. Equal
/// probabilities are listed together or not at all. NaN = not weighed: not listed. @throws
/// std::invalid_argument a probability or the share is not from 0 to 1.
[[nodiscard]] std::vector<bool> list_by_odds(std::span<const double> fault_probability,
                                             double share);

/// Which of the loops that are on the list stay: with the same mean over all that are as probable
/// or more, at a looser share, and down to a probability of `least`. NaN = not weighed: false.
[[nodiscard]] std::vector<bool> stay_by_odds(std::span<const double> fault_probability,
                                             double share, double least);

}  // namespace loopscope::core::plant
