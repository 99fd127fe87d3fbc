#pragma once

#include <vector>

namespace loopscope::core::diagnosis {

/// Natural log odds of a probability, which is kept a millionth away from 0 and 1; and back.
[[nodiscard]] double log_odds_of(double probability);
[[nodiscard]] double probability_of(double log_odds);

/// A place on a curve: the weight of evidence, in log odds, of something with this value.
struct CurvePoint {
  double value = 0.0;
  double weight = 0.0;
};

/// On the lines between the points, level outside of them; `points`, by ascending value, is not
/// empty, `value` not NaN.
[[nodiscard]] double height_at(const std::vector<CurvePoint>& points, double value);

}  // namespace loopscope::core::diagnosis
