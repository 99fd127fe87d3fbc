#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace loopscope::core::hos {

/// Samples of a record that nobody stored, and what is known of them all the same: an archive that
/// stores what leaves a band says of the others that they did not leave it. In the record's unit.
struct Holes {
  std::vector<double> low;   ///< as long as the record; NaN = no hole, -infinity = not bounded
  std::vector<double> high;  ///< likewise, low <= high, +infinity = not bounded

  [[nodiscard]] bool empty() const { return low.empty(); }
};

/// The record with its holes filled by one draw from what they may have been, given all stored
/// samples, the bounds, and that the loop is linear and its noise Gaussian.
///
/// That is the hypothesis that the tests of significance.hpp test, so that a record with its holes
/// drawn is, where the hypothesis holds, a record without holes, and the tests keep their level;
/// a line or a step through the same holes is coupled in phase to what it connects. A nonlinear
/// loop stays nonlinear by the samples that were stored.
///
/// The linear process is the record's own (linear_model.hpp), found together with the draw: fitted,
/// drawn, fitted again (data augmentation, Tanner and Wong 1987). `record` holds a first guess in
/// every hole; NaN that is no hole stays missing and separates pieces. The same seed gives the same
/// draw. Nothing is drawn (the guesses stay) when no model can be fitted.
[[nodiscard]] std::vector<double> draw_missing(std::span<const double> record, const Holes& holes,
                                               std::uint64_t seed);

}  // namespace loopscope::core::hos
