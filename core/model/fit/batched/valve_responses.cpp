#include "core/model/fit/batched/valve_responses.hpp"

#include "core/model/fit/batched/lane_kernel.hpp"

namespace loopscope::core::model {

ValveResponses::ValveResponses(std::span<const double> op, const Structure& structure,
                               std::span<const Signal> steady, std::span<const Range> rows)
    : op_(op), structure_(structure), steady_(steady), rows_(rows) {}

std::vector<Eigen::MatrixXd> ValveResponses::products(std::span<const ValveAndProcess> valves,
                                                      Digits digits) const {
  const ResponseTask task{op_, structure_.noise, structure_.two_taps ? 2U : 1U, steady_, rows_};
  const LaneKernel& kernel = best_lane_kernel();
  return digits == Digits::full ? kernel.full_answers(task, valves)
                                : kernel.single_answers(task, valves);
}

}  // namespace loopscope::core::model
