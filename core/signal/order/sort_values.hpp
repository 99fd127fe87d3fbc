#pragma once

#include <vector>

namespace loopscope::core::signal {

/// Puts values in ascending order (-0 before +0). By the digits of their bit patterns (radix 256)
/// where they are many: a window takes a fifth of the time of comparisons, whose outcome no
/// processor guesses. No value may be NaN.
void sort_values(std::vector<double>& values);

}  // namespace loopscope::core::signal
