#pragma once

namespace loopscope::core::model {

/// What op does at a sample, as valves see it.
template <typename Element>
struct OpStep {
  Element op;
  Element before;     ///< op a sample earlier
  Element direction;  ///< of op's last motion, +1 or -1
  Element kept;       ///< 0 = op turned, or stood still for the second time: a moving valve stops
  Element turned;     ///< 0 or 1
};

/// Follows op, the same for every valve that sees it.
template <typename Element>
struct OpMotion {
  Element previous = 0;
  Element direction = 1;  ///< of op's last motion
  bool stood_still = true;

  OpStep<Element> take(Element op) {
    const Element slope = op - previous;
    const bool still = slope == 0;
    const bool turned = slope * direction < 0;
    const bool stopped = turned || (still && stood_still);
    direction = turned ? -direction : direction;
    stood_still = still;
    const Element before = previous;
    previous = op;
    return {op, before, direction, Element(stopped ? 0 : 1), Element(turned ? 1 : 0)};
  }
};

}  // namespace loopscope::core::model
