#pragma once

#include <Eigen/Core>
#include <limits>
#include <span>
#include <vector>

#include "core/model/effects/model_structure.hpp"
#include "core/model/record/loop_data.hpp"

namespace loopscope::core::model {

/// A structure fitted to the fit rows of a record.
struct Fit {
  Structure structure;
  /// Numerator (1 or 2), then the effects' columns in their order, then offset (and ramp,
  /// integrating).
  std::vector<double> coefficients;
  double fit_error = 0.0;           ///< mean square of the one-step errors on the fit rows, scaled
  double score_error = 0.0;         ///< the same on the rows held out
  std::vector<double> innovations;  ///< one-step errors of every sample, scaled pv units

  [[nodiscard]] std::size_t taps() const { return structure.two_taps ? 2 : 1; }
  [[nodiscard]] double gain() const {
    return coefficients[0] + (structure.two_taps ? coefficients[1] : 0.0);
  }
};

/// Those of the columns of one effect, by its place among the structure's.
[[nodiscard]] std::span<const double> coefficients_of(const Fit& fit, std::size_t place);

/// Least squares over the coefficients, everything in the structure as it is.
[[nodiscard]] Fit evaluate(const LoopData& data, const Structure& structure);

/// Poles, noise and coefficients by Gauss-Newton from where the structure stands; delay and
/// effects as they are. At most `iterations` steps; never worse than evaluate(). Given up as it
/// stands where even thrice of what the next step promises would not leave a fit_error below
/// `to_beat`.
[[nodiscard]] Fit polish(const LoopData& data, const Structure& start, int iterations = 8,
                         double to_beat = std::numeric_limits<double>::infinity());

/// The output of a fitted model run on op alone, scaled pv units: all columns at their
/// coefficients, nothing of the noise.
[[nodiscard]] std::vector<double> deterministic_output(const LoopData& data, const Fit& fit);

}  // namespace loopscope::core::model
