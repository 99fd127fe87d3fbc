#include "core/diagnosis/cause_curves.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace loopscope::core::diagnosis {
namespace {

#include "core/diagnosis/curves_with_model.inc"
#include "core/diagnosis/curves_without_model.inc"

}  // namespace

const std::vector<CauseCurves>& fitted_curves(bool with_model) {
  static const std::vector<CauseCurves> with = curves_with_model();
  static const std::vector<CauseCurves> without = curves_without_model();
  return with_model ? with : without;
}

double height_at(const std::vector<CurvePoint>& points, double value) {
  if (value <= points.front().value) return points.front().weight;
  if (value >= points.back().value) return points.back().weight;
  const auto right = std::ranges::upper_bound(points, value, {}, &CurvePoint::value);
  const auto left = std::prev(right);
  const double part = (value - left->value) / (right->value - left->value);
  return left->weight + part * (right->weight - left->weight);
}

double weight_at(const FigureCurve& curve, double value) {
  const bool nothing = curve.points.empty() || std::isnan(value);
  return nothing ? curve.not_computed : height_at(curve.points, value);
}

}  // namespace loopscope::core::diagnosis
