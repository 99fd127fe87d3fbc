#include "core/hos/coupling/testable_cells.hpp"

#include <cmath>

#include "core/hos/transforms/window.hpp"

namespace loopscope::core::hos {

TestableCells::TestableCells(const Settings& settings)
    : lobe_(static_cast<std::size_t>(std::ceil(main_lobe_half_width(settings.window) *
                                               static_cast<double>(settings.dft_length) /
                                               static_cast<double>(settings.segment_length)))),
      half_(settings.dft_length / 2) {
  for (std::size_t k2 = lobe_; 2 * k2 <= half_; ++k2) {
    const Range k1 = row(k2);
    if (k1.end > k1.begin) count_ += k1.end - k1.begin;
  }
}

}  // namespace loopscope::core::hos
