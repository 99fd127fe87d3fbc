#pragma once

#include <cstddef>
#include <cstdint>

namespace loopscope::tests::network {

/// Loops of sixty networks, `seed` and following, put together to plants of thirty loops that share
/// nothing: each loop is of another network, every window ends at one time. How many of `plants`
/// show an event all the same; no loop is diagnosed.
[[nodiscard]] std::size_t plants_with_false_event(std::uint64_t seed, std::size_t plants,
                                                  unsigned threads);

}  // namespace loopscope::tests::network
