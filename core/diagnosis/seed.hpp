#pragma once

#include <cstdint>
#include <string_view>

namespace loopscope::core {

/// The seed of an analysis: a hash (FNV-1a, 64 bits) of the loop's name and the time at which the
/// window or its slot ends, microseconds since 1970. Whoever analyses the same window of the same
/// loop again gets the same seed, on any machine.
[[nodiscard]] std::uint64_t seed_of(std::string_view loop_name, std::int64_t end_us);

}  // namespace loopscope::core
