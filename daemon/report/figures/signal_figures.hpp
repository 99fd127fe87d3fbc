#pragma once

#include <vector>

#include "daemon/report/evidence/loop_evidence.hpp"
#include "daemon/report/figures/figure.hpp"
#include "daemon/text/time_zone.hpp"

namespace loopscope::daemon {

/// A stretch of a window, in samples.
struct Stretch {
  std::size_t from = 0;
  std::size_t samples = 0;
};

/// The part of a window in which single swings can be seen: the model's telling stretch, else the
/// end of the window, some eight cycles or a few hundred samples.
[[nodiscard]] Stretch telling_stretch(const LoopEvidence& evidence);

/// sp, pv, op and, where recorded, mv over the whole window, and again over its telling stretch.
[[nodiscard]] std::vector<Figure> trend_figures(const LoopEvidence& evidence, const TimeZone& zone);

/// pv over op, or the valve's position over op where it is recorded, over the telling stretch;
/// nothing where op is not recorded.
[[nodiscard]] std::vector<Figure> valve_figures(const LoopEvidence& evidence);

}  // namespace loopscope::daemon
