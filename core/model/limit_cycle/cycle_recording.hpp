#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/model/limit_cycle/cycle_band.hpp"
#include "core/model/limit_cycle/cycle_evidence.hpp"
#include "core/model/results/mechanism.hpp"
#include "core/signal/loop_window.hpp"

namespace loopscope::core::model {

/// A recording as the judge of limit cycles looks at it. Equal lengths, no holes.
struct CycleRecording {
  signal::Samples pv, op;    ///< bridged where samples are missing
  signal::Samples error;     ///< sp - pv; of a level that nobody knows less pv
  signal::Samples recorded;  ///< 1, or 0 where pv or op is missing
};

/// Throws std::invalid_argument for unequal lengths; sp empty or all missing = not known.
[[nodiscard]] CycleRecording cycle_recording(std::span<const double> pv, std::span<const double> op,
                                             std::span<const double> sp);

/// Why the recording cannot be judged; empty when it can.
[[nodiscard]] std::string unusable(const CycleRecording& recording);

/// The period at which op repeats itself best, samples.
[[nodiscard]] double cycle_period(const CycleRecording& recording, const Without& without = {});

/// The stretches that are judged, those in which op and pv move: the whole of it, or three parts of
/// a long one. They view the recording.
[[nodiscard]] std::vector<CycleRecord> parts_of(const CycleRecording& recording,
                                                const CycleBand& band);

}  // namespace loopscope::core::model
