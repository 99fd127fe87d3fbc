#include "tests/core/simulate/spectrum.hpp"

#include <complex>
#include <cstddef>
#include <numbers>

namespace loopscope::core::simulate::tests {

double power_at(const std::vector<double>& signal, double frequency) {
  constexpr std::size_t kSegment = 1024;
  double power = 0.0;
  std::size_t segments = 0;
  for (std::size_t start = 0; start + kSegment <= signal.size(); start += kSegment) {
    std::complex<double> sum;
    for (std::size_t k = start; k < start + kSegment; ++k) {
      sum +=
          signal[k] * std::polar(1.0, -2.0 * std::numbers::pi * frequency * static_cast<double>(k));
    }
    power += std::norm(sum) / kSegment;
    ++segments;
  }
  return power / static_cast<double>(segments);
}

double variance(const std::vector<double>& signal) {
  double mean = 0.0;
  double square = 0.0;
  const auto count = static_cast<double>(signal.size());
  for (const double value : signal) {
    mean += value / count;
    square += value * value / count;
  }
  return square - mean * mean;
}

}  // namespace loopscope::core::simulate::tests
