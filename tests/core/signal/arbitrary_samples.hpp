#pragma once

#include <cstddef>
#include <cstdint>
#include <rapidcheck.h>

#include "core/signal/grid.hpp"

namespace loopscope::core::signal {

/// Values of a plant's size, missing ones among them, in runs of any length; sixteenths, so that
/// sums and products with small whole numbers are exact.
[[nodiscard]] rc::Gen<Samples> samples_with_gaps();

/// Rows in ascending time within a day, some at one time, some bad. At least one.
[[nodiscard]] rc::Gen<RawSeries> arbitrary_rows();

/// A grid of up to 200 slots of 0.001 s to 600 s that begins within the day of arbitrary_rows().
[[nodiscard]] rc::Gen<Grid> arbitrary_grid();

/// The same number, or both missing.
[[nodiscard]] bool same(double a, double b);
[[nodiscard]] bool same(const Samples& a, const Samples& b);

}  // namespace loopscope::core::signal
