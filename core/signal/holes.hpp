#pragma once

#include "core/signal/archive.hpp"
#include "core/signal/loop_window.hpp"

namespace loopscope::core::signal {

/// pv with a first guess where it was not stored but may be drawn
/// (core/hos/linear/draw_missing.hpp).
struct Reconstruction {
  Samples value;  ///< pv units; stored, guessed, or NaN in a gap
  Samples low;    ///< of a guessed sample, -infinity = not bounded; NaN = stored or a gap; empty =
                  ///< nothing is guessed
  Samples high;   ///< likewise
};

/// Guesses what lies in holes: the line between the stored values, held within the band of a dead
/// band (about the value stored last) or of a swinging door (about that line); a value stored on
/// change stays. Longer runs than archive.hpp allows, and what lies before the first and behind the
/// last stored value, stay missing; a dead band goes on behind the last. A
/// value of a coarse grid is a guess as well, known to within half a step.
[[nodiscard]] Reconstruction reconstruct(const StoredSamples& stored);

}  // namespace loopscope::core::signal
