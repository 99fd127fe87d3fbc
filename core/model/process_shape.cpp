#include "core/model/process_shape.hpp"

#include <algorithm>

namespace loopscope::core::model {

void lag(double pole, std::span<double> signal) {
  if (pole == 0.0 || signal.empty()) return;
  double state = signal.front();
  for (double& value : signal) {
    state += (1.0 - pole) * (value - state);
    value = state;
  }
}

void respond(const ProcessShape& shape, std::span<const double> input, std::span<double> response) {
  const std::size_t shift = std::min(shape.delay_samples, input.size());
  std::fill_n(response.begin(), shift, input.empty() ? 0.0 : input.front());
  std::copy(input.begin(), input.end() - static_cast<std::ptrdiff_t>(shift),
            response.begin() + static_cast<std::ptrdiff_t>(shift));
  lag(shape.second_pole, response);
  if (!shape.integrating) {
    lag(shape.pole, response);
    return;
  }
  double sum = 0.0;
  for (double& value : response) {
    sum += value;
    value = sum;
  }
}

std::vector<double> answer(const ProcessShape& shape, std::span<const double> input) {
  std::vector<double> result(input.size());
  respond(shape, input, result);
  double before = result.empty() ? 0.0 : result.front();
  for (double& value : result) {
    const double now = value;
    value = shape.numerator[0] * now + shape.numerator[1] * before;
    before = now;
  }
  return result;
}

}  // namespace loopscope::core::model
