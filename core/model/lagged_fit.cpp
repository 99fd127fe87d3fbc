#include "core/model/lagged_fit.hpp"

#include "core/model/lane_kernel.hpp"

namespace loopscope::core::model {

LaggedModel fit_lagged(const LaggedRows& rows, std::span<const double> input) {
  return best_lane_kernel().fit_lagged(rows, input);
}

}  // namespace loopscope::core::model
