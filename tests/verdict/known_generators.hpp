#pragma once

#include <cstdint>

#include "tests/verdict/labelled.hpp"

namespace loopscope::tests::verdict {

/// A loop of a kind of tests/effects, drawn by the seed: kind, size of its effects, noise.
[[nodiscard]] SimulatedLoop effects_loop(std::uint64_t seed);

/// A recording of one of the families of tests/core/model, likewise.
[[nodiscard]] SimulatedLoop family_loop(std::uint64_t seed);

}  // namespace loopscope::tests::verdict
