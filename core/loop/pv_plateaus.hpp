#pragma once

#include <optional>
#include <span>

namespace loopscope::core::loop {

/// How pv rests while op travels, over a cycle of the loop: behind a valve that sticks pv stands on
/// two plateaus while integral action ramps op, and jumps between them. Of a vessel, which
/// integrates, the plateaus are in the slope of pv.
///
/// pv is averaged over a twelfth of a cycle; its move from one mean to the next that shares no
/// sample is compared with the root mean square of all such moves. No cycle has to repeat another,
/// so that three are enough.
struct PvPlateaus {
  /// Kurtosis of the moves: 1.5 for a sine, 3 for normal noise, more where pv rests and jumps.
  double move_kurtosis = 0.0;
  /// Share of the time in which pv rests: moves by less than a quarter of the root mean square.
  /// 0.11 for a sine.
  double time_share = 0.0;
  /// Share of op's travel that falls into these rests.
  double op_travel_share = 0.0;
  double cycles = 0.0;  ///< in the record
};

/// pv and op (any units), NaN = missing; `period_samples` of the cycle. nullopt for unequal
/// lengths, with fewer than three cycles or 24 moves, with cycles of less than six samples, or
/// where pv or op stands still.
[[nodiscard]] std::optional<PvPlateaus> measure_pv_plateaus(std::span<const double> pv,
                                                            std::span<const double> op,
                                                            double period_samples,
                                                            bool integrating);

}  // namespace loopscope::core::loop
