#pragma once

#include <cstdint>
#include <random>

namespace loopscope::core::simulate {

/// Uniform numbers that a seed fixes on every platform: the standard prescribes the engine bit for
/// bit, but not what its own distributions make of it.
class UniformSource {
 public:
  explicit UniformSource(std::uint64_t seed) : engine_(seed) {}

  /// The next number, above 0 and below 1, independent of those before.
  [[nodiscard]] double next();

 private:
  std::mt19937_64 engine_;
};

}  // namespace loopscope::core::simulate
