#include "core/hos/numeric/quantile.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>

namespace loopscope::core::hos {
namespace {

/// Upper tail and density of the standard normal at z.
struct Normal {
  explicit Normal(double z)
      : tail(0.5 * std::erfc(z / std::numbers::sqrt2)),
        density(std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi)) {}
  double tail;
  double density;
};

}  // namespace

double upper_normal_quantile(double alpha) {
  // From the leading term of the tail's expansion, Newton's method on the logarithm of the tail:
  // that is concave and nearly a parabola, so every start converges and each step squares the
  // error. Six steps from anywhere within the range; two more cost nothing.
  constexpr int kSteps = 8;
  double z = std::sqrt(-2.0 * std::log(2.0 * alpha));
  for (int step = 0; step < kSteps; ++step) {
    const Normal at(z);
    z += std::log(at.tail / alpha) * at.tail / at.density;
  }
  return z;
}

double sample_quantile(std::span<const double> sorted, double probability) {
  if (sorted.empty()) {
    throw std::invalid_argument("quantile of no values");
  }
  const double position = probability * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], position - static_cast<double>(below));
}

}  // namespace loopscope::core::hos
