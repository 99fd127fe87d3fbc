#pragma once

#include <cstddef>
#include <vector>

#include "tests/core/model/field_loop.hpp"
#include "tests/generators/values.hpp"

namespace loopscope::tests::model {

/// Loops as plants have them, and what all families of recordings share.
using Loop = FieldSettings (*)(Draw&);

using generators::standard_deviation;

/// Samples of a recording.
using Length = std::size_t (*)(Draw&);

std::size_t record_length(Draw& draw);

/// Mean period in samples by crossings of the mean with a quarter of the spread as hysteresis.
double period_of(const std::vector<double>& x);

FieldSettings flow(Draw& draw);

FieldSettings level(Draw& draw);

FieldSettings temperature(Draw& draw);

FieldSettings any_loop(Draw& draw);

/// Noise and a wandering load as shares of what the loop does without them.
void roughen(FieldSettings& s, double swing_pv, double swing_op, Draw& draw);

void historian(FieldSettings& s, double swing_pv, double swing_op, Draw& draw);

}  // namespace loopscope::tests::model
