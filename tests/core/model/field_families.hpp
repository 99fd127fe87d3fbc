#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "tests/core/model/field_loop.hpp"

namespace loopscope::tests::model {

/// A kind of recording as plants have them, with its truth.
struct FieldFamily {
  std::string_view name;
  bool sticks = false;
  bool for_tuning = false;  ///< rules are fitted on these; the others score them
  FieldLoop (*simulate)(Draw& draw) = nullptr;
};

/// A plant knows which of its loops are level loops.
[[nodiscard]] bool is_level(const FieldFamily& family);

[[nodiscard]] std::span<const FieldFamily> sticking_families();
[[nodiscard]] std::span<const FieldFamily> healthy_families();
/// Slow, long, coarse, interacting, interrupted and complicated ones.
[[nodiscard]] std::span<const FieldFamily> plant_sticking_families();
[[nodiscard]] std::span<const FieldFamily> plant_healthy_families();
/// All, in that order.
[[nodiscard]] std::span<const FieldFamily> field_families();

/// One recording of the family, below 100 000: no two families share their random numbers.
[[nodiscard]] FieldLoop record_of(const FieldFamily& family, std::uint64_t seed);

}  // namespace loopscope::tests::model
