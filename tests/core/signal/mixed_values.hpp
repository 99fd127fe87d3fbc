#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace loopscope::core::signal {

/// Values of all sizes and signs, with repetitions; the same for the same seed.
[[nodiscard]] std::vector<double> mixed_values(std::size_t count, std::uint64_t seed);

}  // namespace loopscope::core::signal
