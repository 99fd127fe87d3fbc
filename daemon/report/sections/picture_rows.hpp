#pragma once

#include <span>
#include <vector>

#include "daemon/report/figures/figure.hpp"
#include "daemon/report/page/fields.hpp"

namespace loopscope::daemon {

/// Drawn figures for a template: title, src, width, height, alt.
[[nodiscard]] List picture_rows(std::span<const Picture> pictures);

}  // namespace loopscope::daemon
