#pragma once

#include <cstdint>

#include "core/hos/analyse.hpp"
#include "core/signal/loop_window.hpp"

namespace loopscope::core {

/// Raises the p-values of `result` to what they are worth behind a swinging door.
///
/// A door stores a sample because the next one leaves its band, so that the samples that it leaves
/// out are not only those within the band (core/hos/linear/draw_missing.hpp), and a sharp
/// oscillation keeps a little of the door's corners: 3 f of a loop at the edge of stability shows
/// them. Where a test is near significance, records of the loop's own linear model are sent through
/// the same door, drawn and tested in the same way, and -ln p is divided by the mean that they
/// show, if that is above 1 by more than chance: a p-value is never smaller than before.
///
/// `error` (NaN = missing) is the record that `result` was taken from, `band` the door's half width
/// in its units. Nothing changes for a band of 0, p-values above 0.05 and an error without a linear
/// model. The same seed gives the same result.
void allow_for_door(const signal::Samples& error, double band, const hos::Settings& settings,
                    std::uint64_t seed, hos::Result& result);

}  // namespace loopscope::core
