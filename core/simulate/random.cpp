#include "core/simulate/random.hpp"

#include <cmath>

namespace loopscope::core::simulate {

double GaussianSource::next_symmetric() {
  // The upper 53 bits fill a double's mantissa exactly: no rounding can differ between machines.
  constexpr double kStep = 0x1.0p-52;
  return static_cast<double>(engine_() >> 11U) * kStep - 1.0;
}

double GaussianSource::next() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  double first = 0.0;
  double second = 0.0;
  double square = 0.0;
  do {
    first = next_symmetric();
    second = next_symmetric();
    square = first * first + second * second;
  } while (square >= 1.0 || square == 0.0);
  const double scale = std::sqrt(-2.0 * std::log(square) / square);
  spare_ = second * scale;
  has_spare_ = true;
  return first * scale;
}

double UniformSource::next() {
  // 52 random bits and a half: exact in a double, and neither 0 nor 1, so that a logarithm of it or
  // of its complement is finite.
  constexpr double kStep = 0x1.0p-52;
  return (static_cast<double>(engine_() >> 12U) + 0.5) * kStep;
}

}  // namespace loopscope::core::simulate
