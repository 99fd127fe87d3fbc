#include "core/model/results/explanation.hpp"

#include <algorithm>
#include <cmath>

namespace loopscope::core::model {

std::string_view name(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::one_step:
      return "one_step";
    case ErrorKind::simulation:
      return "simulation";
  }
  return "";
}

double explained_by(const Step& step) {
  const double drop = std::log(step.holdout_error_before / step.holdout_error_after);
  return std::isfinite(drop) ? std::max(drop, 0.0) : 0.0;
}

}  // namespace loopscope::core::model
