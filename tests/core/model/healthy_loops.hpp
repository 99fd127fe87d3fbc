#pragma once

#include "tests/core/model/field_bases.hpp"

namespace loopscope::tests::model {

/// A wave of 12 to 150 steps from outside, of unit amplitude, that wanders in phase and fades.
[[nodiscard]] OutsideWave outside(OutsideWave::Shape shape, bool at_input, Draw& draw);

/// A healthy loop with its waves; a good valve still holds a little: in half of the records up to
/// 10 % of op's standard deviation.
[[nodiscard]] FieldLoop waved(FieldSettings settings, Draw& draw, bool archive_too = false,
                              Length length = record_length);

/// The controller's gain multiplied to `share` of where the loop starts to swing by itself.
[[nodiscard]] FieldSettings tightened(FieldSettings settings, double share, Draw& draw);

}  // namespace loopscope::tests::model
