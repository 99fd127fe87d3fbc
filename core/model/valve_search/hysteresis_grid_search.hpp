#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "core/model/fit/fit.hpp"

namespace loopscope::core::model {

/// A valve with the process and noise that it was looked at behind.
struct GridResult {
  Structure structure;     ///< the valve is its last effect
  double fit_error = 0.0;  ///< Fit::fit_error
};

/// Valves that follow their law from op alone, where pv is too noisy to put a valve's position
/// right by, and hysteresis costs a few percent of the one-step error.
///
/// The best play on a net of bands, each with a process of its own: the linear loop takes play for
/// delay. One that shows no hope of leaving less than `to_beat` is given up half fitted. nullopt
/// where op stands still.
[[nodiscard]] std::optional<GridResult> find_play(
    const LoopData& data, const Fit& now, double to_beat = std::numeric_limits<double>::infinity());

/// Bands that the net looks at: what a play found on it has been chosen from.
[[nodiscard]] std::size_t hysteresis_net_bands();

/// By the printed and by Kano's law the best valve with a jump on a net about that play, behind the
/// linear loop's process and that of the play: one of the two is close enough for the narrow
/// minimum of the right law to show.
[[nodiscard]] std::vector<GridResult> find_sticking(const LoopData& data, const Fit& now,
                                                    const GridResult& play);

}  // namespace loopscope::core::model
