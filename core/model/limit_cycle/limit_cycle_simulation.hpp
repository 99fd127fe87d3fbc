#pragma once

#include <optional>
#include <vector>

#include "core/model/record/loop_data.hpp"
#include "core/model/results/explanation.hpp"

namespace loopscope::core::model {

/// What the witness of a step of find_hysteresis() makes of pv, by sample, pv units: his models run
/// on op alone, each fitted to all that he looks at, plus what he leaves out of his comparison
/// because it is slower than the cycle. Straight lines between the means that he works with. NaN =
/// he has not looked there: of a long record the cycle is judged in three parts.
struct WitnessSimulation {
  std::vector<double> linear;
  std::vector<double> valve;  ///< behind it; of two valves (cycle_fits.hpp) the one that the step
                              ///< rests on: that with the lower error held out
};

/// nullopt where the witness has nothing to say of the record: `step` is not of it.
[[nodiscard]] std::optional<WitnessSimulation> simulate_limit_cycle(const ModelInput& input,
                                                                    const Step& step);

}  // namespace loopscope::core::model
