#include "core/signal/lasting_error.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace loopscope::core::signal {
namespace {

/// Noise crosses zero now and then even where the mean error is one and a third of its standard
/// deviations.
constexpr double kSameSide = 0.9;

}  // namespace

bool keeps_its_sign(std::span<const double> error, double least) {
  std::size_t above = 0;
  std::size_t below = 0;
  std::size_t recorded = 0;
  for (const double value : error) {
    if (!std::isfinite(value)) continue;
    ++recorded;
    above += value > least ? 1 : 0;
    below += value < -least ? 1 : 0;
  }
  const double enough = kSameSide * static_cast<double>(recorded);
  return recorded > 0 && static_cast<double>(std::max(above, below)) >= enough;
}

}  // namespace loopscope::core::signal
