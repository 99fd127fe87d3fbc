#pragma once

namespace loopscope::core::loop {

/// At least hos::f_deviate(ratio, freedom_1, freedom_2), for a tenth of its time: nearly all bands
/// of a spectrum are known by it to be no peak. `freedom_1` >= 2 and `freedom_2` >= 4; less than
/// 0.5 above the deviate within -1 to 1.5, infinite where that is about 2 or more. NaN for NaN and
/// for an infinite ratio.
/// Source: the cube root of a chi square is nearly normal (Wilson and Hilferty 1931; of a ratio
/// Paulson 1942).
[[nodiscard]] double f_deviate_bound(double ratio, double freedom_1, double freedom_2);

}  // namespace loopscope::core::loop
