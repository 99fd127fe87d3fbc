#include "core/loop/ellipse.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/hos/numeric/symmetric_eigen.hpp"

namespace loopscope::core::loop {
namespace {

/// Below this the two signals do not belong to one oscillation.
constexpr double kLeastOpPvCorrelation = 0.3;
/// Five coefficients need more points than that by far.
constexpr std::size_t kFewestPoints = 50;
/// A plot thinner than this share of its length is a line: what width it has is rounding.
constexpr double kThinnest = 1e-3;

using Points = std::vector<Eigen::Vector2d>;  // (op, pv)

/// (p - centre)^T form (p - centre) = 1.
struct Ellipse {
  Eigen::Vector2d centre;
  Eigen::Matrix2d form;
};

/// Takes the plot to mean 0 and covariance 1: the fit does not depend on the axes, its numerics do.
struct Whitening {
  Eigen::Vector2d mean;
  Eigen::Matrix2d to_white;
  double thickness = 0.0;  // smaller over larger principal standard deviation
};

std::ptrdiff_t best_lag(const Correlation& op_pv, double period) {
  const auto reach =
      std::min(static_cast<std::ptrdiff_t>(op_pv.max_lag), static_cast<std::ptrdiff_t>(period / 2));
  std::ptrdiff_t best = 0;
  for (std::ptrdiff_t lag = -reach; lag <= reach; ++lag) {
    if (std::abs(op_pv.at(lag)) > std::abs(op_pv.at(best))) best = lag;
  }
  return best;
}

/// Pairs op(k), pv(k + lag), each as a share of its largest absolute value.
Points collect_points(std::span<const double> op, std::span<const double> pv, std::ptrdiff_t lag) {
  const auto first = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, -lag));
  const auto last = op.size() - static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, lag));
  Points points;
  points.reserve(op.size());
  Eigen::Vector2d largest = Eigen::Vector2d::Zero();
  for (std::size_t k = first; k < last; ++k) {
    const auto moved = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(k) + lag);
    const Eigen::Vector2d point(op[k], pv[moved]);
    if (!point.allFinite()) continue;
    points.push_back(point);
    largest = largest.cwiseMax(point.cwiseAbs());
  }
  for (auto& p : points) p = p.cwiseQuotient(largest);
  return points;
}

Whitening measure_whitening(const Points& points) {
  const auto count = static_cast<double>(points.size());
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const auto& p : points) mean += p / count;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  for (const auto& p : points) covariance += (p - mean) * (p - mean).transpose() / count;
  const hos::SymmetricEigen eigen = hos::symmetric_eigen(covariance);
  const Eigen::Vector2d std = eigen.values.cwiseMax(0.0).cwiseSqrt();
  const Eigen::Matrix2d to_white = std.cwiseInverse().asDiagonal() * eigen.vectors.transpose();
  return {mean, to_white, std(0) / std(1)};
}

/// a x^2 + b x y + c y^2 + d x + e y + f = 0 through white points, coefficients a to f. The moments
/// are split into the quadratic and the linear part (Halir and Flusser 1998), which keeps the
/// eigenvalue problem at 3 x 3.
std::optional<Eigen::Matrix<double, 6, 1>> fit_conic(const Points& points) {
  Eigen::Matrix3d s1 = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d s2 = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d s3 = Eigen::Matrix3d::Zero();
  for (const auto& p : points) {
    const Eigen::Vector3d squares(p.x() * p.x(), p.x() * p.y(), p.y() * p.y());
    const Eigen::Vector3d lines(p.x(), p.y(), 1.0);
    s1 += squares * squares.transpose();
    s2 += squares * lines.transpose();
    s3 += lines * lines.transpose();
  }
  const Eigen::Matrix3d to_linear = -s3.inverse() * s2.transpose();
  const Eigen::Matrix3d reduced = s1 + s2 * to_linear;
  // Inverse of the constraint 4 a c - b^2 = 1: it swaps and scales the rows.
  Eigen::Matrix3d problem;
  problem << reduced.row(2) / 2.0, -reduced.row(1), reduced.row(0) / 2.0;
  if (!problem.allFinite()) return std::nullopt;
  const Eigen::EigenSolver<Eigen::Matrix3d> solver(problem);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Eigen::Vector3d v = solver.eigenvectors().col(i).real();
    if (!(4.0 * v(0) * v(2) - v(1) * v(1) > 0.0)) continue;
    Eigen::Matrix<double, 6, 1> conic;
    conic << v, to_linear * v;
    return conic;
  }
  return std::nullopt;
}

std::optional<Ellipse> fit_ellipse(const Points& white_points) {
  const auto conic = fit_conic(white_points);
  if (!conic) return std::nullopt;
  Eigen::Matrix2d form;
  form << (*conic)(0), 0.5 * (*conic)(1), 0.5 * (*conic)(1), (*conic)(2);
  const Eigen::Vector2d linear = conic->segment<2>(3);
  const Eigen::Vector2d centre = -0.5 * form.inverse() * linear;
  const double radius = -((*conic)(5) + 0.5 * linear.dot(centre));
  const Ellipse ellipse{centre, form / radius};
  if (!ellipse.form.allFinite() || !(ellipse.form(0, 0) > 0.0)) return std::nullopt;
  return ellipse;
}

/// Scatter of the points' radius (1 on the ellipse) relative to that of a normal cloud, whose
/// radius is Rayleigh distributed: variance over mean square = 1 - pi / 4.
double goodness(const Points& white_points, const Ellipse& ellipse) {
  constexpr double kCloud = 1.0 - std::numbers::pi / 4.0;
  double squares = 0.0;
  double misfit = 0.0;
  for (const auto& p : white_points) {
    const Eigen::Vector2d from_centre = p - ellipse.centre;
    const double square = from_centre.dot(ellipse.form * from_centre);
    const double miss = std::sqrt(square) - 1.0;
    squares += square;
    misfit += miss * miss;
  }
  return std::clamp(1.0 - misfit / (kCloud * squares), 0.0, 1.0);
}

double op_span(const Points& points) {
  const auto [low, high] = std::minmax_element(
      points.begin(), points.end(), [](const auto& l, const auto& r) { return l.x() < r.x(); });
  return high->x() - low->x();
}

/// Extent of the ellipse in op where pv is that of its centre.
double width_in_op(const Ellipse& white_ellipse, const Whitening& whitening) {
  const Eigen::Vector2d along_op = whitening.to_white.col(0);
  return 2.0 / std::sqrt(along_op.dot(white_ellipse.form * along_op));
}

}  // namespace

std::optional<EllipseFigures> measure_ellipse(std::span<const double> op,
                                              std::span<const double> pv, const Correlation& op_pv,
                                              double period) {
  if (op_pv.values.empty()) return std::nullopt;
  const std::ptrdiff_t lag = best_lag(op_pv, period);
  if (!(std::abs(op_pv.at(lag)) >= kLeastOpPvCorrelation)) return std::nullopt;
  Points points = collect_points(op, pv, lag);
  if (points.size() < kFewestPoints) return std::nullopt;
  const double span = op_span(points);
  const Whitening whitening = measure_whitening(points);
  if (!(whitening.thickness >= kThinnest)) return EllipseFigures{0.0, 1.0};
  for (auto& p : points) p = whitening.to_white * (p - whitening.mean);
  const std::optional<Ellipse> ellipse = fit_ellipse(points);
  if (!ellipse) return std::nullopt;
  const double share = width_in_op(*ellipse, whitening) / span;
  const double r2 = goodness(points, *ellipse);
  if (!std::isfinite(share) || !std::isfinite(r2)) return std::nullopt;
  return EllipseFigures{std::min(100.0, 100.0 * share), r2};
}

}  // namespace loopscope::core::loop
