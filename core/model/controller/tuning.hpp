#pragma once

#include <string>

#include "core/model/controller/controller_law.hpp"
#include "core/model/results/explanation.hpp"

namespace loopscope::core::model {

/// What the implied closed loop says of the tuning.
enum class Tuning {
  fine,
  tight,         ///< close to instability
  sluggish,      ///< far slower than the process allows
  contradictory  ///< unstable by so much that fit and record cannot both be right
};

struct TuningJudgement {
  Tuning tuning = Tuning::fine;
  ClosedLoop loop;
  ClosedLoop reference;   ///< the same process under the SIMC rules
  double slowness = 1.0;  ///< integral action of SIMC by the recorded one; the integral of the
                          ///< error after a load step is longer by this; 0 = no integral action
  double settling_ratio = 1.0;  ///< settling by that under SIMC
  std::string statement;        ///< one sentence with the figures
};

/// Self-regulating loops are sluggish when integral action is less than a quarter of SIMC's;
/// integrating ones never are, they may be meant to average. Thresholds hold with the process 20 %
/// off in gain and time constant (core/model/controller/MEASURED.md). Throws std::invalid_argument
/// unless interval_s > 0 and the fit's gain is not 0.
[[nodiscard]] TuningJudgement judge_tuning(const ProcessFit& fit, const ControllerLaw& law,
                                           double interval_s);

}  // namespace loopscope::core::model
