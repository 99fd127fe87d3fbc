#include "core/loop/shape.hpp"

#include <algorithm>
#include <cmath>

#include "core/loop/correlation.hpp"
#include "core/loop/ellipse.hpp"
#include "core/loop/horch.hpp"
#include "core/loop/record_spectrum.hpp"
#include "core/loop/shape_index.hpp"
#include "core/loop/valve_plot.hpp"
#include "core/signal/order/spread.hpp"

namespace loopscope::core::loop {
namespace {

/// Half the fundamental to just above the seventh harmonic: drift and sampling noise pull every
/// figure towards "undecided", and higher harmonics of a triangle hold less than a thousandth.
constexpr double kLowestHarmonic = 0.5;
constexpr double kHighestHarmonic = 8.0;

/// The oscillation and its harmonics. Gaps of up to an eighth of the period are drawn through.
signal::Samples oscillating_part(std::span<const double> series, const signal::Spread& spread,
                                 double period, RealTransform& transform) {
  return RecordSpectrum(series, spread, transform)
      .component({kLowestHarmonic / period, kHighestHarmonic / period},
                 static_cast<std::size_t>(period / 8.0));
}

void measure_op_and_pv(const signal::Samples& op, const signal::Samples& pv, double period,
                       RealTransform& transform, Shape& shape) {
  const auto reach = static_cast<std::size_t>(std::ceil(period));
  const Correlation op_pv = correlate(op, pv, std::min(reach, op.size() / 2), transform);
  if (const auto horch = measure_horch(op_pv, period)) {
    shape.horch_dtau = horch->dtau;
    shape.horch_drho = horch->drho;
  }
  if (const auto ellipse = measure_ellipse(op, pv, op_pv, period)) {
    shape.ellipse_stiction = ellipse->stiction;
    shape.ellipse_r2 = ellipse->r2;
  }
}

/// A period that the record holds; others cannot be cut out of it.
bool is_measurable(const std::optional<double>& period, std::size_t samples) {
  return period && *period >= 2.0 && *period <= static_cast<double>(samples) / 2.0;
}

}  // namespace

Shape measure_shape(const ShapeInput& input) {
  Shape shape;
  const ValvePlot plot = measure_valve_plot(input.op_percent, input.mv_percent);
  shape.mv_op_width = plot.width;
  shape.mv_slip_jump = plot.slip_jump;
  shape.mv_stuck_fraction = plot.stuck_fraction;
  if (!is_measurable(input.period_samples, input.pv.size())) return shape;
  if (input.op_percent.size() != input.pv.size()) return shape;
  const auto op_spread = signal::measure_spread(input.op_percent);
  const auto pv_spread = signal::measure_spread(input.pv);
  if (!op_spread || !pv_spread || op_spread->constant() || pv_spread->constant()) return shape;

  const double period = *input.period_samples;
  RealTransform transform(transform_length(input.pv.size()));
  const signal::Samples op = oscillating_part(input.op_percent, *op_spread, period, transform);
  const signal::Samples pv = oscillating_part(input.pv, *pv_spread, period, transform);
  shape.shape_index = measure_shape_index(input.integrating ? pv : op, period);
  measure_op_and_pv(op, pv, period, transform, shape);
  return shape;
}

}  // namespace loopscope::core::loop
