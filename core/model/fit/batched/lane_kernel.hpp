#pragma once

#include <Eigen/Core>
#include <span>
#include <string_view>
#include <vector>

#include "core/model/fit/batched/valve_responses.hpp"
#include "core/model/record/loop_data.hpp"
#include "core/model/response/noise_model.hpp"
#include "core/model/response/products.hpp"

namespace loopscope::core::model {

/// What valves answer to, and what their answers are multiplied by; see ValveResponses.
struct ResponseTask {
  std::span<const double> op;
  const NoiseModel& noise;
  std::size_t taps;
  std::span<const Signal> steady;
  std::span<const Range> rows;
};

/// What goes side by side in vectors, for one kind of processor. The digits of a lane do not depend
/// on how many there are, and sums are added in one order: all kinds give the same results.
struct LaneKernel {
  using Products = std::vector<Eigen::MatrixXd> (*)(const ResponseTask& task,
                                                    std::span<const ValveAndProcess> valves);
  std::string_view name;    ///< of the kind of processor, as Highway calls it
  Products single_answers;  ///< ValveResponses::products(), Digits::single
  Products full_answers;    ///< the same, Digits::full
};

/// The fastest that this processor can run.
[[nodiscard]] const LaneKernel& best_lane_kernel();

}  // namespace loopscope::core::model
