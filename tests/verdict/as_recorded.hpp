#pragma once

#include <cstdint>

#include "tests/verdict/labelled.hpp"

namespace loopscope::tests::verdict {

/// The loop as a historian keeps it and a catalogue describes it: a stretch of 512 to 4096 samples,
/// at 0.1 to 60 s, rounded, compressed, with gaps, centred, with and without ranges, setpoint,
/// controller output and valve position.
[[nodiscard]] LabelledRecord as_recorded(const SimulatedLoop& loop, std::uint64_t seed);

/// The record with this number: of one of the three generators, as recorded.
[[nodiscard]] LabelledRecord draw_record(std::uint64_t seed);

}  // namespace loopscope::tests::verdict
