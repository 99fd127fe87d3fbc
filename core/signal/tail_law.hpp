#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace loopscope::core::signal {

/// How far sizes reach by chance, by the tail of all of them: the Weibull law,
/// p = exp(-(size / scale)^shape), through the sizes that 20 % and 5 % exceed.
///
/// Exponential and Laplacian tails follow it, Gaussian ones end a little earlier, so that a true
/// extreme is rarely called too large; up to 2 % outliers lengthen it by a third.
class TailLaw {
 public:
  /// `sizes` are at or above 0. nullopt where no tail can be told: no size, 80 % of them 0, or
  /// 15 % of them equal.
  [[nodiscard]] static std::optional<TailLaw> of(std::span<const double> sizes);

  /// How many of the sizes are expected beyond `size`.
  [[nodiscard]] double expected_beyond(double size) const;

 private:
  double count_ = 0.0;
  double outer_ = 0.0;
  double shape_ = 0.0;
};

}  // namespace loopscope::core::signal
