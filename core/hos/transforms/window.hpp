#pragma once

#include <cstddef>
#include <vector>

#include "core/hos/transforms/settings.hpp"

namespace loopscope::core::hos {

/// The `length` weights of a taper; formulas at WindowShape. `length` >= 2.
[[nodiscard]] std::vector<double> make_window(WindowShape shape, std::size_t length);

/// Half the width between the first zeros of the window's spectrum, in bins of the segment (cycles
/// per segment): two lines closer than this are one line to the estimate.
[[nodiscard]] double main_lobe_half_width(WindowShape shape);

}  // namespace loopscope::core::hos
