#pragma once

#include <optional>
#include <span>

#include "core/loop/correlation.hpp"

namespace loopscope::core::loop {

/// The ellipse that the pv-op plot runs along.
struct EllipseFigures {
  double stiction = 0.0;  ///< extent in op at the mean of pv, % of op's own span, 0 to 100
  double r2 = 0.0;        ///< 1 = every point on the ellipse, 0 = as scattered as a cloud of noise
};

/// Direct least-squares ellipse (Fitzgibbon, Pilu and Fisher 1999) on the plot of op against pv,
/// pv moved by the lag (up to half of `period`, samples) at which the two correlate best: a linear
/// loop then lies on a line, and what is left of the width is apparent stiction (Choudhury, Shah,
/// Thornhill and Shook 2006). Both signals without drift and sampling noise, NaN = missing, of one
/// length; `op_pv` is correlate(op, pv). nullopt when |correlation| < 0.3 at every lag, fewer than
/// 50 pairs are recorded or no ellipse fits; 0 and 1 where all points lie on one line.
[[nodiscard]] std::optional<EllipseFigures> measure_ellipse(std::span<const double> op,
                                                            std::span<const double> pv,
                                                            const Correlation& op_pv,
                                                            double period);

}  // namespace loopscope::core::loop
