#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "tests/plants/network/plan.hpp"

namespace loopscope::tests::network {

/// Where the oscillation of a plant comes from.
enum class Origin {
  valve,    ///< of one loop, anywhere
  recycle,  ///< of one loop whose stream goes back to the first unit
  outside,  ///< no loop of the plant
};

/// A plan and what was put into it.
struct Draft {
  PlantPlan with;                      ///< as it is recorded
  PlantPlan without;                   ///< the same without the shared cause
  std::optional<std::size_t> source;   ///< nullopt = outside
  std::vector<std::size_t> unrelated;  ///< loops with an oscillation of their own
};

/// Thirty loops: supplies, and four units in a row with a recycle, cascades, one cause.
/// `kind` = of the source.
[[nodiscard]] Draft draw_plan(std::uint64_t seed, Origin origin, LoopKind kind);

}  // namespace loopscope::tests::network
