#include "core/hos/numeric/normal_draw.hpp"

#include <algorithm>
#include <cmath>

namespace loopscope::core::hos {
namespace {

/// Farther from the mean than this, in standard deviations, the law is drawn by its tail; nearer, a
/// fifth of all draws at least lie between limits that are not nearly flat.
constexpr double kTail = 0.5;
/// Farther out the law has no width left: the nearer limit is drawn.
constexpr double kFarthest = 1e6;

/// Whether the density changes by less than a factor of e between the limits.
bool nearly_flat(double from, double to) {
  const double farthest = std::max(std::abs(from), std::abs(to));
  return farthest <= kFarthest && (to - from) * farthest <= 1.0;
}

/// Even draws between the limits, kept as often as the density there is a share of the largest: a
/// third of them at least (Robert 1995).
double draw_nearly_flat(double from, double to, std::mt19937_64& random) {
  const double densest = std::clamp(0.0, from, to);
  for (;;) {
    const double value = from + (to - from) * uniform_draw(random);
    const double log_share = 0.5 * (densest * densest - value * value);
    const double drawn = uniform_draw(random);
    // exp(x) >= 1 + x spares most of the exponentials.
    if (drawn <= 1.0 + log_share || drawn <= std::exp(log_share)) return value;
  }
}

/// Exponential draws between the limits, at the rate of which most are kept: three of four where
/// the upper one is far (Robert 1995).
double draw_in_tail(double from, double to, std::mt19937_64& random) {
  from = std::min(from, kFarthest);
  const double rate = 0.5 * (from + std::sqrt(from * from + 4.0));
  const double within = -std::expm1(-rate * std::max(0.0, to - from));
  for (;;) {
    const double value = from - std::log1p(-within * uniform_draw(random)) / rate;
    const double off = value - rate;
    if (uniform_draw(random) <= std::exp(-0.5 * off * off)) return value;
  }
}

/// Of the law with mean 0 and standard deviation 1.
double draw_between(double from, double to, std::mt19937_64& random) {
  if (nearly_flat(from, to)) return draw_nearly_flat(from, to, random);
  if (from > kTail) return draw_in_tail(from, to, random);
  if (to < -kTail) return -draw_in_tail(-to, -from, random);
  double value = normal_draw(random);
  // Limits that are no numbers end this at once.
  while (value < from || value > to) value = normal_draw(random);
  return value;
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
  const double drawn = draw_between((low - mean) / std, (high - mean) / std, random);
  return std::clamp(mean + std * drawn, low, high);
}

}  // namespace loopscope::core::hos
