#pragma once

#include <vector>

namespace loopscope::core::signal {

/// Puts values in ascending order (-0 before +0). Where they are many, into bands between their
/// extremes and in order there, or, where values crowd, by the digits of their bit patterns (radix
/// 256): comparisons, whose outcome no processor guesses, take five times as long for a window. No
/// value may be NaN.
void sort_values(std::vector<double>& values);

}  // namespace loopscope::core::signal
