#include "core/model/response/process_shape.hpp"

#include <algorithm>

#include "core/model/vectors/recursion-inl.hpp"

namespace loopscope::core::model {
namespace {

/// y(k) = root y(k-1) + gain x(k); `y` and `x` may be the same.
void recur(double root, double before, double gain, std::span<const double> x, double* y) {
  run_recursion(
      root, before, x.size(), [&](std::size_t k) { return gain * x[k]; },
      [&](std::size_t k, double value) { y[k] = value; });
}

}  // namespace

void lag(double pole, std::span<double> signal) {
  if (pole == 0.0 || signal.empty()) return;
  recur(pole, signal.front(), 1.0 - pole, signal, signal.data());
}

void respond(const ProcessShape& shape, std::span<const double> input, std::span<double> response) {
  const std::size_t shift = std::min(shape.delay_samples, input.size());
  const double first = input.empty() ? 0.0 : input.front();
  // At rest until the first sample comes through; an integrator sums that up meanwhile.
  for (std::size_t k = 0; k < shift; ++k) {
    response[k] = shape.integrating ? first * static_cast<double>(k + 1) : first;
  }
  std::span<const double> rest = input.first(input.size() - shift);
  double* out = response.data() + shift;
  if (shape.second_pole != 0.0) {
    recur(shape.second_pole, first, 1.0 - shape.second_pole, rest, out);
    rest = {out, rest.size()};
  }
  if (shape.integrating) {
    recur(1.0, first * static_cast<double>(shift), 1.0, rest, out);
  } else {
    recur(shape.pole, first, 1.0 - shape.pole, rest, out);
  }
}

void weigh(const std::array<double, 2>& numerator, std::span<double> response) {
  if (numerator[1] == 0.0 && numerator[0] == 1.0) return;
  double before = response.empty() ? 0.0 : response.front();
  for (double& value : response) {
    const double now = value;
    value = numerator[0] * now + numerator[1] * before;
    before = now;
  }
}

std::vector<double> answer(const ProcessShape& shape, std::span<const double> input) {
  std::vector<double> result(input.size());
  respond(shape, input, result);
  weigh(shape.numerator, result);
  return result;
}

}  // namespace loopscope::core::model
