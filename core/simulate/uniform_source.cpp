#include "core/simulate/uniform_source.hpp"

namespace loopscope::core::simulate {

double UniformSource::next() {
  // 52 random bits and a half: exact in a double, and neither 0 nor 1, so that a logarithm of it or
  // of its complement is finite.
  constexpr double kStep = 0x1.0p-52;
  return (static_cast<double>(engine_() >> 12U) + 0.5) * kStep;
}

}  // namespace loopscope::core::simulate
