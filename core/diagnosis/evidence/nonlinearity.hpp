#pragma once

#include <string>

#include "core/diagnosis/evidence/evidence.hpp"
#include "core/hos/transforms/settings.hpp"

namespace loopscope::core::diagnosis {

/// What the calibrated tests say, for the decision; both looks taken together.
struct NonlinearityFinding {
  bool found = false;  ///< p <= alpha of the settings
  double p = 1.0;      ///< that a linear loop under its own noise looks like this or more so
  std::string reason;  ///< names the coupling, the p-values and the published figures
};

/// p of one look, or of the stronger of two, corrected for having looked twice (Sidak). 1 when the
/// statistics have no p-value.
[[nodiscard]] double nonlinear_p(const Evidence& evidence);

/// `evidence.hos` is filled. "Linear" is never said: a linear loop and one whose coupling the tests
/// cannot see look the same.
[[nodiscard]] NonlinearityFinding judge_nonlinearity(const Evidence& evidence,
                                                     const hos::Settings& settings);

}  // namespace loopscope::core::diagnosis
