#include "core/diagnosis/odds/cause_curves.hpp"

#include <cmath>

namespace loopscope::core::diagnosis {
namespace {

#include "core/diagnosis/odds/curves_with_model.inc"
#include "core/diagnosis/odds/curves_without_model.inc"

}  // namespace

const std::vector<CauseCurves>& fitted_curves(bool with_model) {
  static const std::vector<CauseCurves> with = curves_with_model();
  static const std::vector<CauseCurves> without = curves_without_model();
  return with_model ? with : without;
}

double weight_at(const FigureCurve& curve, double value) {
  const bool nothing = curve.points.empty() || std::isnan(value);
  return nothing ? curve.not_computed : height_at(curve.points, value);
}

}  // namespace loopscope::core::diagnosis
