#pragma once

#include <cstddef>

#include "core/model/limit_cycle/limit_cycle_cause.hpp"
#include "tests/core/model/field_families.hpp"

namespace loopscope::core::model::tests {

[[nodiscard]] CycleCause judge(const loopscope::tests::model::FieldLoop& loop);

/// Share of `records` loops of the family that are judged as they are. Undecided is not accused.
[[nodiscard]] double right_share(const loopscope::tests::model::FieldFamily& family,
                                 std::size_t records);

}  // namespace loopscope::core::model::tests
