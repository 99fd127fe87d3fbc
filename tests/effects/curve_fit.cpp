#include "tests/effects/curve_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace loopscope::tests::effects {
namespace {

std::pair<double, double> range(std::vector<double> positions) {
  std::sort(positions.begin(), positions.end());
  const double last = static_cast<double>(positions.size() - 1);
  return {positions[static_cast<std::size_t>(0.02 * last)],
          positions[static_cast<std::size_t>(0.98 * last)]};
}

}  // namespace

double travel(const std::vector<double>& positions) {
  const auto [low, high] = range(positions);
  return high - low;
}

double centred_curvature(const Curve& curve, const std::vector<double>& positions) {
  const double mean = std::accumulate(positions.begin(), positions.end(), 0.0) /
                      static_cast<double>(positions.size());
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const double position : positions) {
    const double x = position - mean;
    const Eigen::Vector3d row(1.0, x, x * x);
    normal += row * row.transpose();
    right += row * curve(position);
  }
  const Eigen::Vector3d fit = normal.ldlt().solve(right);
  return 50.0 * fit(2) / fit(1);
}

double gain_ratio(const Curve& curve, const std::vector<double>& positions) {
  constexpr int kPoints = 50;
  const auto [low, high] = range(positions);
  const double width = (high - low) / kPoints;
  double least = 0.0;
  double most = 0.0;
  for (int i = 0; i < kPoints; ++i) {
    const double slope = std::abs(curve(low + (i + 1) * width) - curve(low + i * width)) / width;
    least = i == 0 ? slope : std::min(least, slope);
    most = std::max(most, slope);
  }
  return most / least;
}

}  // namespace loopscope::tests::effects
