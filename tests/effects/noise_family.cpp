#include "tests/effects/noise_family.hpp"

#include <cmath>

namespace loopscope::tests::effects {

std::optional<NoiseFamily> noise_family_of(std::string_view word) {
  if (word == "gaussian") return NoiseFamily::gaussian;
  if (word == "t5") return NoiseFamily::t5;
  if (word == "bursts") return NoiseFamily::bursts;
  if (word == "garch") return NoiseFamily::garch;
  return std::nullopt;
}

double Volatility::next() {
  switch (family_) {
    case NoiseFamily::t5:
      return next_t5();
    case NoiseFamily::bursts:
      return next_burst();
    case NoiseFamily::garch:
      return next_garch();
    case NoiseFamily::gaussian:
      break;
  }
  return 1.0;
}

/// A normal by the root of chi square over its five degrees; t has the variance 5/3.
double Volatility::next_t5() {
  constexpr int kDegrees = 5;
  double chi_square = 0.0;
  for (int i = 0; i < kDegrees; ++i) chi_square += std::pow(random_.normal(), 2);
  return std::sqrt((kDegrees - 2.0) / chi_square);
}

double Volatility::next_burst() {
  constexpr double kLoudness = 4.0;
  constexpr double kShare = 0.1;
  constexpr double kLength = 40.0;
  const double turns = loud_ ? 1.0 / kLength : kShare / (1.0 - kShare) / kLength;
  if (random_.chance(turns)) loud_ = !loud_;
  const double mean_square = 1.0 + kShare * (kLoudness * kLoudness - 1.0);
  return (loud_ ? kLoudness : 1.0) / std::sqrt(mean_square);
}

double Volatility::next_garch() {
  constexpr double kNews = 0.1;
  constexpr double kMemory = 0.85;
  const double size = std::sqrt(variance_);
  variance_ =
      (1.0 - kNews - kMemory) + kNews * std::pow(size * random_.normal(), 2) + kMemory * variance_;
  return size;
}

}  // namespace loopscope::tests::effects
