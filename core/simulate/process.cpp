#include "core/simulate/process.hpp"

#include <cmath>
#include <stdexcept>

namespace loopscope::core::simulate {

Process::Process(const ProcessModel& model) : model_(model), inputs_(model.delay_samples + 1, 0.0) {
  if (model.delay_samples == 0 || !(std::abs(model.pole) <= 1.0)) {
    throw std::invalid_argument("process: a delay >= 1 and a pole of -1 to 1 are needed");
  }
}

double Process::input_before(std::size_t samples) const {
  return inputs_[(newest_ + inputs_.size() - samples) % inputs_.size()];
}

void Process::advance(double input) {
  newest_ = (newest_ + 1) % inputs_.size();
  inputs_[newest_] = input;
  output_ = model_.pole * output_ + model_.b0 * input_before(model_.delay_samples - 1) +
            model_.b1 * input_before(model_.delay_samples);
}

}  // namespace loopscope::core::simulate
