#include "core/diagnosis/odds/log_odds.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace loopscope::core::diagnosis {

double log_odds_of(double probability) {
  // What is surer than a million to one is as sure as a model of a plant can be.
  constexpr double kLeast = 1e-6;
  const double p = std::clamp(probability, kLeast, 1.0 - kLeast);
  return std::log(p / (1.0 - p));
}

double probability_of(double log_odds) {
  return 1.0 / (1.0 + std::exp(-log_odds));
}

double height_at(const std::vector<CurvePoint>& points, double value) {
  if (value <= points.front().value) return points.front().weight;
  if (value >= points.back().value) return points.back().weight;
  const auto right = std::ranges::upper_bound(points, value, {}, &CurvePoint::value);
  const auto left = std::prev(right);
  const double part = (value - left->value) / (right->value - left->value);
  return left->weight + part * (right->weight - left->weight);
}

}  // namespace loopscope::core::diagnosis
