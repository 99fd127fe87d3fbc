#pragma once

#include <cstddef>
#include <span>

#include "core/signal/loop_window.hpp"

namespace loopscope::core::signal {

/// How many samples the controller was run in which way.
struct ModeCounts {
  std::size_t manual = 0;
  std::size_t automatic = 0;  ///< or cascade
  std::size_t unknown = 0;
  [[nodiscard]] std::size_t known() const { return manual + automatic; }
};
[[nodiscard]] ModeCounts count_modes(std::span<const ControlMode> mode);

}  // namespace loopscope::core::signal
