#pragma once

#include <span>

#include "core/hos/linear/innovations.hpp"

namespace loopscope::core::hos {

/// Do the innovations depend on the past in a way that no linear model has?
struct InnovationTest {
  double even_p = 1.0;             ///< on squares of the past, as quadratic coupling does
  double odd_p = 1.0;              ///< on cubes, as of an odd-symmetric limit cycle
  [[nodiscard]] double p() const;  ///< either, Bonferroni
};

/// Score test after Tsay (1986), in the form that allows for heavy tails and changing loudness
/// (White 1980): innovations over their local scale against squares and cubes of the exponentially
/// weighted past (time constants of 3, 8 and 20 samples), each less what lags and weighted pasts
/// explain of it,
///
///     z = sum u g / sqrt(sum u^2 g^2),
///
/// standard normal where u has mean zero given the past. Innovations and pasts are clipped at 2.5
/// standard deviations: what a few samples say does not count. Where next to nothing is left
/// without them (single impulses and no background) u is the model's misfit, and z too large. The
/// weighted pasts are taken out twice, as they are and saturated at one standard deviation: the
/// best prediction of a line or a slow load beside heavy-tailed noise trusts small moves more than
/// large ones, and neither is nonlinear. It needs no simulation and sees what couples the past to
/// the next sample (a valve that sticks), where coherences over segments see what keeps a phase.
///
/// `signal` (NaN = missing) is the record of `innovations`. Each p counts its three time constants;
/// both are 1 with fewer than four known innovations for each column.
[[nodiscard]] InnovationTest test_innovations(std::span<const double> signal,
                                              const Innovations& innovations);

}  // namespace loopscope::core::hos
