#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "core/signal/assemble.hpp"
#include "core/signal/loop_window.hpp"

namespace loopscope::core::signal {

/// One recorded loop, its rows stamped in seconds.
struct LoopRecording {
  std::vector<double> time_s;
  Samples sp, pv, op;  ///< op may be empty
};

/// A loop by name: a scenario of core/simulate, or an autoregressive signal (`broad`, `osc`,
/// `noisy_osc`, `white`) about 50.
[[nodiscard]] LoopRecording recording_of(const std::string& loop, std::uint64_t seed);

/// What happens to a recording on its way.
struct Damage {
  std::string name;
  std::function<LoopRecording(LoopRecording, std::uint64_t seed)> apply;
  /// What is left of the record to judge, its longest stationary stretch, is a linear loop's.
  bool leaves_linear = false;
};

/// Every kind that the gate is measured on.
[[nodiscard]] std::span<const Damage> all_damages();

/// Those that a test looks at in each of its runs.
[[nodiscard]] bool is_quick(const Damage& damage);

/// The window of a file that holds these rows, as the program takes it.
[[nodiscard]] LoopWindow window_of(const LoopRecording& recording);

}  // namespace loopscope::core::signal
