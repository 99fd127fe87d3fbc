#include "core/simulate/disturbances.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace loopscope::core::simulate {
namespace {

std::ptrdiff_t place(const std::vector<double>& signal, double share) {
  return static_cast<std::ptrdiff_t>(share * static_cast<double>(signal.size()));
}

}  // namespace

std::vector<double> with_level(std::vector<double> signal, double from, double to, double factor) {
  std::for_each(signal.begin() + place(signal, from), signal.begin() + place(signal, to),
                [factor](double& value) { value *= factor; });
  return signal;
}

std::vector<double> with_step(std::vector<double> signal, double from, double size) {
  std::for_each(signal.begin() + place(signal, from), signal.end(),
                [size](double& value) { value += size; });
  return signal;
}

std::vector<double> running_sum(std::vector<double> signal) {
  std::partial_sum(signal.begin(), signal.end(), signal.begin());
  return signal;
}

}  // namespace loopscope::core::simulate
