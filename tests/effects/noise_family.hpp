#pragma once

#include <optional>
#include <string_view>

#include "tests/effects/random.hpp"

namespace loopscope::tests::effects {

/// What a plant's noise is like beside Gaussian: loads and readings of another size from sample to
/// sample, of the same variance in the mean.
enum class NoiseFamily {
  gaussian,
  t5,      ///< Student's t with five degrees of freedom, each sample by itself
  bursts,  ///< four times as loud in stretches of 40 samples on average, a tenth of the time
  garch,   ///< size follows the sizes before: GARCH(1, 1) of 0.1 and 0.85
};

/// The word of --noise; nullopt = none of them.
[[nodiscard]] std::optional<NoiseFamily> noise_family_of(std::string_view word);

/// Size of a sample's noise by that of Gaussian noise; its mean square is 1.
class Volatility {
 public:
  Volatility(NoiseFamily family, std::uint64_t seed) : family_(family), random_(seed) {}
  [[nodiscard]] double next();

 private:
  [[nodiscard]] double next_t5();
  [[nodiscard]] double next_burst();
  [[nodiscard]] double next_garch();

  NoiseFamily family_;
  Random random_;
  bool loud_ = false;
  double variance_ = 1.0;
};

}  // namespace loopscope::tests::effects
