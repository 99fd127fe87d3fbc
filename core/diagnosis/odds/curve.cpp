#include "core/diagnosis/odds/curve.hpp"

#include <algorithm>
#include <iterator>

namespace loopscope::core::diagnosis {

double height_at(const std::vector<CurvePoint>& points, double value) {
  if (value <= points.front().value) return points.front().weight;
  if (value >= points.back().value) return points.back().weight;
  const auto right = std::ranges::upper_bound(points, value, {}, &CurvePoint::value);
  const auto left = std::prev(right);
  const double part = (value - left->value) / (right->value - left->value);
  return left->weight + part * (right->weight - left->weight);
}

}  // namespace loopscope::core::diagnosis
