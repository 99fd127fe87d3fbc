#pragma once

#include <string_view>
#include <vector>

#include "core/diagnosis/odds/explaining_away.hpp"
#include "core/diagnosis/odds/log_odds.hpp"

namespace loopscope::core::diagnosis {

/// What one figure says of one cause: straight between its points, level outside of them.
struct FigureCurve {
  std::string_view figure;         ///< figure.hpp
  double not_computed = 0.0;       ///< weight, log odds, of a figure that was not computed
  std::vector<CurvePoint> points;  ///< by ascending value
};

/// The log odds of one cause: a sum over figures (Good 1950; Spiegelhalter and Knill-Jones 1984).
/// Over the loops of the fit the weights of a curve have the mean 0.
struct CauseCurves {
  std::string_view cause;  ///< code of the verdict
  double share = 0.0;      ///< of the loops of the fit, 0 to 1: its prior
  double log_odds = 0.0;   ///< where all figures say nothing
  ExplainingAway beside;
  std::vector<FigureCurve> curves;
};

/// The fitted tables (curves_with_model.inc and its sister, written by tests/verdict/train): for
/// loops with a model, whose figures of steps and closed loop are among the curves, and for loops
/// without one. `nonlinear_unexplained` stands for any nonlinearity of valve or process.
[[nodiscard]] const std::vector<CauseCurves>& fitted_curves(bool with_model);

/// Weight of a value, log odds; `not_computed` for NaN and for a curve without points.
[[nodiscard]] double weight_at(const FigureCurve& curve, double value);

}  // namespace loopscope::core::diagnosis
