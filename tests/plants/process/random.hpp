#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

namespace loopscope::tests::process {

/// A seed of its own for part `part` of what `seed` stands for (splitmix64, Steele et al. 2014).
[[nodiscard]] inline std::uint64_t seed_of_part(std::uint64_t seed, std::uint64_t part) {
  std::uint64_t z = seed + 0x9E3779B97F4A7C15ULL * (part + 1);
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31);
}

/// The lot: the same numbers for the same seed.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed_of_part(seed, 0)) {}

  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  double log_uniform(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  double normal() { return normal_(engine_); }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  /// Below `count`.
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(engine_() % count); }
  std::uint64_t seed() { return engine_(); }

 private:
  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
};

}  // namespace loopscope::tests::process
