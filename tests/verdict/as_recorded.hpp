#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/verdict/labelled.hpp"

namespace loopscope::tests::verdict {

/// The loop as a historian keeps it and a catalogue describes it: a stretch of 512 to 4096 samples,
/// at 0.1 to 60 s, rounded, compressed, with gaps, centred, with and without ranges, setpoint,
/// controller output and valve position.
[[nodiscard]] LabelledRecord as_recorded(const SimulatedLoop& simulated, std::uint64_t seed);

/// The record with this number: of one of the three generators, as recorded.
[[nodiscard]] LabelledRecord draw_record(std::uint64_t seed);

/// A window of a loop that is looked at again and again.
struct SuccessiveWindow {
  LabelledRecord record;
  double new_share = 1.0;  ///< of its samples, those that the window before it did not hold
};

/// `count` windows that slide over the record with this number, the oldest first: of 512 samples to
/// half of it, by steps of one length. Empty where the record is too short for that.
[[nodiscard]] std::vector<SuccessiveWindow> draw_windows(std::uint64_t seed, std::size_t count);

}  // namespace loopscope::tests::verdict
