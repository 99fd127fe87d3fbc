#include "core/model/valve_tracking.hpp"

#include "core/model/lane_kernel.hpp"

namespace loopscope::core::model {

std::vector<OpStep<float>> op_steps(std::span<const double> op) {
  std::vector<OpStep<float>> steps;
  steps.reserve(op.size());
  OpMotion<float> motion{op.empty() ? 0.0F : static_cast<float>(op[0])};
  for (const double value : op) {
    steps.push_back(motion.take(static_cast<float>(value)));
  }
  return steps;
}

TrackedValve track_valve(const TrackedRecord& record, const Valve& valve, const LaggedModel& model,
                         std::size_t rows_per_stretch) {
  return best_tracking_kernel().track(record, valve, model, rows_per_stretch);
}

LaggedModel fit_untracked(const TrackedRecord& record, const Valve& valve) {
  std::vector<double> mv(record.op.size());
  run_valve(valve, record.op, mv);
  std::vector<double> by_row(record.rows.output.size());
  const double share = 1.0 / static_cast<double>(record.steps_per_row);
  for (std::size_t row = 0; row < by_row.size(); ++row) {
    for (std::size_t step = 0; step < record.steps_per_row; ++step) {
      by_row[row] += share * mv[row * record.steps_per_row + step];
    }
  }
  return fit_lagged(record.rows, by_row);
}

}  // namespace loopscope::core::model
