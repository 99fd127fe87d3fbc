#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/signal/loop_window.hpp"

namespace loopscope::core::signal {

/// 16 hexadecimal digits over every sample of the window, its times, the range of op and `settings`
/// (any text that names the settings in force). Equal input gives equal digits on every machine; a
/// late row that changes one sample changes them. FNV-1a by words of 64 bits, folded: meant to
/// notice change, not to resist malice.
[[nodiscard]] std::string window_digest(const LoopWindow& window, std::string_view settings);

/// The seed of an analysis: a hash of the samples of pv alone. Whoever analyses the same samples
/// again gets the same seed and with it the same figures to the last digit: under whatever name,
/// out of whatever file or table, on any machine.
[[nodiscard]] std::uint64_t window_seed(const LoopWindow& window);

}  // namespace loopscope::core::signal
