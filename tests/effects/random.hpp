#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string_view>

namespace loopscope::tests::effects {

/// Draws that are the same on every machine: splitmix64 (Steele, Lea and Flood 2014), normals by
/// Box and Muller.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  [[nodiscard]] std::uint64_t next();
  [[nodiscard]] double uniform(double low, double high);
  [[nodiscard]] double log_uniform(double low, double high);  ///< 0 < low <= high
  [[nodiscard]] double normal();                              ///< mean 0, variance 1
  [[nodiscard]] bool chance(double probability);
  [[nodiscard]] int whole(int low, int high);  ///< both ends included
  [[nodiscard]] double pick(std::initializer_list<double> values);
  [[nodiscard]] double sign() { return chance(0.5) ? 1.0 : -1.0; }

 private:
  std::uint64_t state_;
};

/// A seed for one use of `seed`, so that two kinds of record with the same number share nothing.
[[nodiscard]] std::uint64_t seed_for(std::string_view use, std::uint64_t seed);

}  // namespace loopscope::tests::effects
