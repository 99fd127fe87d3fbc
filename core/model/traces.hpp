#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/model/record/loop_data.hpp"
#include "core/model/results/explanation.hpp"

namespace loopscope::core::model {

/// pv beside the model as it stood at one point of the explanation. Series are as long as the
/// record, in pv units; NaN = not recorded, not defined there, or within the first rows (40 at
/// most) that no fit counts because its filters still remember what was before the record. A series
/// that the stage does not have is empty.
///
/// **One step ahead**: each half of the rows as the fit to the other half predicts them, by the
/// fits that the step was judged by. No fit has seen what it is compared with here, but for the few
/// rows of guard before each block, which count in no figure, and the forty about a sudden effect,
/// which both halves see. Behind a held sensor the rows are its renewals; in between pv is known:
/// prediction and measured value are one, and the residual is 0.
///
/// **Simulated**: the model run on op, with the effects so far, alone, plus the offset and the
/// cubic drift that simulation_error.hpp fits. Where the errors of the explanation are simulation
/// errors it is the simulation of the cycle that the valve was found by
/// (limit_cycle_simulation.hpp), in the first stage without the valve; the stage of that valve has
/// no one-step series.
struct TraceStage {
  std::optional<EffectKind> effect;  ///< taken in by this stage; nullopt = the linear baseline
  std::vector<double> one_step_prediction;
  std::vector<double> one_step_residual;  ///< measured less the prediction
  std::vector<double> simulated;
  std::vector<bool> held_out;  ///< whether the sample's residual counts in `one_step_error`
  /// Mean square of `one_step_residual` over `held_out`; NaN without one. Where the errors of the
  /// explanation are one-step errors that is, up to rounding, Baseline::holdout_error for the first
  /// stage and Step::holdout_error_after for that of a step. (Samples without pv among the forty
  /// about a sudden effect do not count here, and the last renewal of a held sensor counts as long
  /// as it is recorded.) Step::holdout_error_before and simulation_ratio are of the
  /// model without the effect after process and noise were sought again, on the rows of that step:
  /// not quite the stage before.
  double one_step_error = 0.0;
  /// Mean square of measured less simulated, pv units squared, on the rows that this fit has not
  /// seen; of a simulated cycle wherever both are, with the fast noise that its own comparison
  /// filters out.
  double simulation_error = 0.0;
};

/// An explanation and the series that it tells of.
struct ExplanationTraces {
  Explanation explanation;       ///< that of explain(), to the last bit
  std::vector<double> measured;  ///< pv as recorded, pv units
  /// The linear baseline and one for each step, in their order. A step that changes nothing of the
  /// model (a coarse grid of the sensor) repeats the series of the stage before it.
  std::vector<TraceStage> stages;
  /// The stretch in which the first effect that changes the model lowers the error most; without
  /// one, the middle of the record. A few hundred samples: about six cycles of op, 200 to 600, of a
  /// held sensor 60 renewals at least; never longer than the record.
  std::size_t telling_from = 0;
  std::size_t telling_samples = 0;
};

/// explain(), with the series behind it. nullopt and exceptions as explain(). Costs little more
/// than that; where the errors are simulation errors, the cycle is simulated once more.
[[nodiscard]] std::optional<ExplanationTraces> trace_explanation(const ModelInput& input);

}  // namespace loopscope::core::model
