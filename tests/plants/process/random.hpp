#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace loopscope::tests::process {

/// One step of splitmix64 (Steele et al. 2014).
[[nodiscard]] inline std::uint64_t mixed(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31);
}

inline constexpr std::uint64_t kGoldenStep = 0x9E3779B97F4A7C15ULL;

/// A seed of its own for part `part` of what `seed` stands for.
[[nodiscard]] inline std::uint64_t seed_of_part(std::uint64_t seed, std::uint64_t part) {
  return mixed(mixed(seed + kGoldenStep) + kGoldenStep * (part + 1));
}

/// The lot: the same numbers for the same seed. Eight bytes of state, since a plant has sixty of
/// them and draws from each at every step.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed_of_part(seed, 0)) {}

  std::uint64_t seed() { return mixed(state_ += kGoldenStep); }
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(seed() >> 11) * 0x1p-53;
  }
  double log_uniform(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  /// Below `count`.
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(seed() % count); }

  /// Marsaglia's polar method, two at a time.
  double normal() {
    if (has_spare_) {
      has_spare_ = false;
      return spare_;
    }
    double x = 0.0, y = 0.0, square = 0.0;
    do {
      x = uniform(-1.0, 1.0);
      y = uniform(-1.0, 1.0);
      square = x * x + y * y;
    } while (square >= 1.0 || square == 0.0);
    const double factor = std::sqrt(-2.0 * std::log(square) / square);
    spare_ = y * factor;
    has_spare_ = true;
    return x * factor;
  }

 private:
  std::uint64_t state_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace loopscope::tests::process
