#include "core/simulate/coloured_noise.hpp"

#include <cmath>
#include <numbers>

namespace loopscope::core::simulate {

AllPole real_pole(double pole) {
  return {.a1 = pole, .a2 = 0.0};
}

AllPole resonance(double period_samples, double radius) {
  return {.a1 = 2.0 * radius * std::cos(2.0 * std::numbers::pi / period_samples),
          .a2 = -radius * radius};
}

std::vector<double> coloured_noise(const AllPole& filter, Innovation law, std::size_t samples,
                                   std::uint64_t seed) {
  constexpr std::size_t kSettling = 4000;  // 0.995^4000 = 2e-9
  const std::vector<double> drive = innovations(law, kSettling + samples, seed);
  std::vector<double> signal(samples);
  double last = 0.0;
  double before = 0.0;
  for (std::size_t k = 0; k < drive.size(); ++k) {
    const double next = filter.a1 * last + filter.a2 * before + drive[k];
    before = last;
    last = next;
    if (k >= kSettling) {
      signal[k - kSettling] = next;
    }
  }
  return signal;
}

}  // namespace loopscope::core::simulate
