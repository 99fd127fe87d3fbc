#pragma once

namespace loopscope::core::simulate {

/// A process whose answer is curved: y -> y + c y^2 / 50, y the answer's distance from the
/// operating point in pv units. Beyond the vertex, where the parabola would turn back, it stays.
struct ProcessNonlinearity {
  double curvature = 0.5;  ///< c, -1 to 1; the slope is 1 + 2c y / 50
};

/// A process gain that changes: factor 1 before `at_s`, then `ratio`; with a rate it gets there in
/// a straight line of that slope.
struct GainChange {
  double at_s = 2000.0;        ///< seconds after the first recorded sample, >= 0
  double ratio = 2.0;          ///< gain after the change / gain before, 0.01 to 100
  double rate_per_hour = 0.0;  ///< change of the factor per hour, >= 0; 0 = at once
};

/// Throws std::invalid_argument for a curvature outside -1 to 1.
void check(const ProcessNonlinearity& nonlinearity);
/// Throws std::invalid_argument for figures outside their ranges.
void check(const GainChange& change);

/// pv units from the operating point.
[[nodiscard]] double curved_answer(const ProcessNonlinearity& nonlinearity, double answer);

/// The factor on the process gain at `time_s` after the first recorded sample.
[[nodiscard]] double gain_factor(const GainChange& change, double time_s);

}  // namespace loopscope::core::simulate
