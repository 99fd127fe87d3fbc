#pragma once

#include <cstdint>

#include "tests/verdict/labelled.hpp"

namespace loopscope::tests::verdict {

/// A loop of any kind with any mixture of valve, disturbance, tuning, limit, trim and sensor, from
/// faint to gross, and any number of cycles from three on: what the families with one story each
/// leave out.
[[nodiscard]] SimulatedLoop mixed_loop(std::uint64_t seed);

}  // namespace loopscope::tests::verdict
