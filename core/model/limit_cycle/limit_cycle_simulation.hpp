#pragma once

#include <optional>
#include <vector>

#include "core/model/record/loop_data.hpp"
#include "core/model/results/explanation.hpp"

namespace loopscope::core::model {

/// pv as the simulation behind a step of find_hysteresis() gives it, by sample, pv units: the
/// models of the cycle (or of op's slow travel) run on op alone, each fitted to all of the samples
/// that are judged, plus the drift that the comparison leaves out because it is slower than the
/// cycle. Straight lines between means. NaN = not judged: of a long record the cycle is in three
/// parts.
struct WitnessSimulation {
  std::vector<double> linear;
  std::vector<double> valve;  ///< behind it; of two valves (cycle_fits.hpp) the one that the step
                              ///< rests on: that with the lower error held out
};

/// nullopt where the record cannot be judged so: `step` is not of it.
[[nodiscard]] std::optional<WitnessSimulation> simulate_limit_cycle(const ModelInput& input,
                                                                    const Step& step);

}  // namespace loopscope::core::model
