#include "tests/core/signal/mixed_values.hpp"

#include <cmath>
#include <random>

namespace loopscope::core::signal {

std::vector<double> mixed_values(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_int_distribution<int> kind(0, 9);
  std::vector<double> values(count);
  for (double& value : values) {
    const int drawn = kind(random);
    value = normal(random);
    if (drawn == 0) value = std::round(value);
    if (drawn == 1) value *= 1e300;
    if (drawn == 2) value *= 1e-310;  // below the least normal number
  }
  return values;
}

}  // namespace loopscope::core::signal
