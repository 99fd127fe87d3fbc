#include "core/loop/shape_index.hpp"

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/loop/zero_crossings.hpp"

namespace loopscope::core::loop {
namespace {

/// Every half cycle is drawn on this many points between its crossings: the seventh harmonic, the
/// highest one kept, still has nine of them to a cycle.
constexpr Eigen::Index kPoints = 31;
/// Peaks are searched over the middle 80 %: nearer to an end a wave is a saw tooth, and both shapes
/// fit it alike.
constexpr Eigen::Index kFirstPeak = 3;
constexpr Eigen::Index kLastPeak = kPoints - 1 - kFirstPeak;
constexpr double kShortestHalfCycle = 5.0;
constexpr std::size_t kFewestHalfCycles = 4;

using HalfCycle = Eigen::Matrix<double, kPoints, 1>;
/// One shape per column, of unit norm, so that a least-squares fit is one inner product.
using Shapes = Eigen::Matrix<double, kPoints, kLastPeak - kFirstPeak + 1>;

template <typename QuarterWave>
Shapes make_shapes(QuarterWave quarter_wave) {
  Shapes shapes;
  for (Eigen::Index column = 0; column < shapes.cols(); ++column) {
    const auto peak = static_cast<double>(kFirstPeak + column + 1);
    for (Eigen::Index point = 0; point < kPoints; ++point) {
      const auto rise = static_cast<double>(point + 1) / peak;
      const auto fall = static_cast<double>(kPoints - point) / (kPoints + 1.0 - peak);
      shapes(point, column) = quarter_wave(std::min(rise, fall));
    }
    shapes.col(column).normalize();
  }
  return shapes;
}

const Shapes& sines() {
  static const Shapes shapes =
      make_shapes([](double x) { return std::sin(0.5 * std::numbers::pi * x); });
  return shapes;
}

const Shapes& triangles() {
  static const Shapes shapes = make_shapes([](double x) { return x; });
  return shapes;
}

/// Squares left by the best shape.
double misfit(const HalfCycle& half_cycle, const Shapes& shapes) {
  const double best = (shapes.transpose() * half_cycle).cwiseAbs().maxCoeff();
  return std::max(0.0, half_cycle.squaredNorm() - best * best);
}

/// MSE_sine / (MSE_sine + MSE_triangle); nullopt when the half cycle touches a gap.
std::optional<double> index_of(const HalfCycle& half_cycle) {
  const double size = half_cycle.norm();
  if (!std::isfinite(size) || !(size > 0.0)) return std::nullopt;
  const HalfCycle unit = half_cycle / size;
  const double sine = misfit(unit, sines());
  const double triangle = misfit(unit, triangles());
  return sine / (sine + triangle);
}

/// The signal between two positions on evenly spaced points, by straight lines.
HalfCycle draw(std::span<const double> signal, double from, double to) {
  HalfCycle result;
  for (Eigen::Index point = 0; point < kPoints; ++point) {
    const double position = from + (to - from) * static_cast<double>(point + 1) / (kPoints + 1.0);
    const auto before = static_cast<std::size_t>(position);
    const double fraction = position - static_cast<double>(before);
    result(point) = signal[before] + fraction * (signal[before + 1] - signal[before]);
  }
  return result;
}

}  // namespace

std::optional<double> measure_shape_index(std::span<const double> oscillation, double period) {
  const double expected = 0.5 * period;
  if (!(expected >= kShortestHalfCycle)) return std::nullopt;
  const std::vector<double> crossings = find_zero_crossings(oscillation);
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 1; i < crossings.size(); ++i) {
    const double length = crossings[i] - crossings[i - 1];
    if (length < 0.5 * expected || length > 1.5 * expected) continue;
    const auto index = index_of(draw(oscillation, crossings[i - 1], crossings[i]));
    if (!index) continue;
    sum += *index;
    ++count;
  }
  if (count < kFewestHalfCycles) return std::nullopt;
  return sum / static_cast<double>(count);
}

}  // namespace loopscope::core::loop
