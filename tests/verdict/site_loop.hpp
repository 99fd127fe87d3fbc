#pragma once

#include <cstdint>

#include "tests/verdict/labelled.hpp"

namespace loopscope::tests::verdict {

/// A loop as a site has many of: most of them healthy, SIMC tuned, recorded far faster or slower
/// than they move, by transmitters of twelve bits and in outputs of whole percent; pv in percent
/// of its span. Three in ten have one fault. Drawn by the seed.
[[nodiscard]] SimulatedLoop site_loop(std::uint64_t seed);

}  // namespace loopscope::tests::verdict
