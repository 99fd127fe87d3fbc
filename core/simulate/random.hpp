#pragma once

#include <cstdint>
#include <random>

namespace loopscope::core::simulate {

/// Standard normal numbers that a seed fixes on every platform.
///
/// The engine is prescribed bit for bit by the C++ standard, the standard library's normal
/// distribution is not: so the transformation (Marsaglia's polar method) stands here.
class GaussianSource {
 public:
  explicit GaussianSource(std::uint64_t seed) : engine_(seed) {}

  /// The next number: mean 0, variance 1, independent of those before.
  [[nodiscard]] double next();

 private:
  /// Uniform on [-1, 1), 53 random bits.
  [[nodiscard]] double next_symmetric();

  std::mt19937_64 engine_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

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
