#include "core/signal/mode_counts.hpp"

namespace loopscope::core::signal {

ModeCounts count_modes(std::span<const ControlMode> mode) {
  ModeCounts counts;
  for (const ControlMode sample : mode) {
    if (sample == ControlMode::manual)
      ++counts.manual;
    else if (sample == ControlMode::unknown)
      ++counts.unknown;
    else
      ++counts.automatic;
  }
  return counts;
}

}  // namespace loopscope::core::signal
