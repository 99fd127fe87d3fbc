#include "core/hos/numeric/normal_draw.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/hos/numeric/distributions.hpp"

namespace loopscope::core::hos {
namespace {

/// Draws of the whole law before the part within the limits is inverted: inverting costs as much as
/// twenty draws.
constexpr int kTries = 8;
/// Less probability than this between the limits is rounding of the distribution function.
constexpr double kLeastShare = 1e-12;
/// Halvings of the interval between the limits: 2^-50 of it is its rounding.
constexpr int kHalvings = 50;

double below(double x) {
  return normal_upper(-x);
}

/// From the limit that is nearer to the mean outwards.
double draw_in_tail(double mean, double std, double low, double high, std::mt19937_64& random) {
  const bool above = mean < low;
  const double distance = std::max(1.0, (above ? low - mean : mean - high) / std);
  const double step = -std::log1p(-uniform_draw(random)) / distance * std;
  return std::clamp(above ? low + step : high - step, low, high);
}

double invert(double share, double low, double high) {
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (below(middle) < share ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Whether the density changes by less than a factor of e between the limits.
bool nearly_flat(double from, double to) {
  constexpr double kFarthest = 1e6;  // squares of more lose the difference that counts
  const double farthest = std::max(std::abs(from), std::abs(to));
  return farthest <= kFarthest && (to - from) * farthest <= 1.0;
}

/// Even draws between the limits, kept as often as the density there is a share of the largest: a
/// third of them at least (Robert 1995).
double draw_nearly_flat(double from, double to, std::mt19937_64& random) {
  const double densest = std::clamp(0.0, from, to);
  for (;;) {
    const double value = from + (to - from) * uniform_draw(random);
    if (uniform_draw(random) <= std::exp(0.5 * (densest * densest - value * value))) return value;
  }
}

}  // namespace

double normal_draw(std::mt19937_64& random) {
  for (;;) {
    const double x = 2.0 * uniform_draw(random) - 1.0;
    const double y = 2.0 * uniform_draw(random) - 1.0;
    const double square = x * x + y * y;
    if (square > 0.0 && square < 1.0) return x * std::sqrt(-2.0 * std::log(square) / square);
  }
}

double normal_draw_within(double mean, double std, double low, double high,
                          std::mt19937_64& random) {
  const double near = (low - mean) / std;
  const double far = (high - mean) / std;
  if (nearly_flat(near, far)) {
    return std::clamp(mean + std * draw_nearly_flat(near, far, random), low, high);
  }
  for (int i = 0; i < kTries; ++i) {
    const double value = mean + std * normal_draw(random);
    if (value >= low && value <= high) return value;
  }
  // Beyond 40 standard deviations nothing is left of the law.
  constexpr double kEnd = 40.0;
  const double from = std::clamp((low - mean) / std, -kEnd, kEnd);
  const double to = std::clamp((high - mean) / std, -kEnd, kEnd);
  const double first = below(from);
  const double share = below(to) - first;
  if (!(share > kLeastShare)) return draw_in_tail(mean, std, low, high, random);
  return std::clamp(mean + std * invert(first + share * uniform_draw(random), from, to), low, high);
}

}  // namespace loopscope::core::hos
