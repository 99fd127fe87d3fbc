#pragma once

#include <cstdint>
#include <string>

namespace loopscope::daemon {

/// A seed, 0 to 2^64 - 1 in decimal digits. Throws Failure (usage) for anything else.
[[nodiscard]] std::uint64_t parse_seed(const std::string& text);

/// Seconds between samples, 1e-6 to 1e6. Throws Failure (usage) for anything else.
[[nodiscard]] double parse_interval_s(const std::string& text);

}  // namespace loopscope::daemon
