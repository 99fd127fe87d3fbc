#include "core/hos/surrogates/innovation_test.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/hos/numeric/distributions.hpp"

namespace loopscope::core::hos {
namespace {

constexpr std::array kTimeConstants = {3.0, 8.0, 20.0};
constexpr Eigen::Index kPasts = kTimeConstants.size();
/// Standard deviations: no few samples decide; and where trust in a large move ends.
constexpr double kClippedAt = 2.5;
constexpr double kTrusted = 1.0;
/// Innovations per column below which the columns explain by chance what they should not.
constexpr Eigen::Index kFewestPerColumn = 4;

using Places = std::vector<Eigen::Index>;

Places known_places(const std::vector<double>& innovations) {
  Places places;
  for (std::size_t t = 0; t < innovations.size(); ++t) {
    if (std::isfinite(innovations[t])) places.push_back(static_cast<Eigen::Index>(t));
  }
  return places;
}

/// The samples about their mean over their standard deviation; 0 where missing.
Eigen::VectorXd standardised(std::span<const double> signal, double mean) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(std::ssize(signal));
  for (Eigen::Index t = 0; t < x.size(); ++t) {
    const double value = signal[static_cast<std::size_t>(t)];
    if (std::isfinite(value)) x[t] = value - mean;
  }
  return x / std::sqrt(x.squaredNorm() / static_cast<double>(x.size()));
}

/// The sum of all samples before each, weighted by exp(-age / time constant), clipped.
Eigen::VectorXd weighted_past(const Eigen::VectorXd& x, double time_constant) {
  const double memory = std::exp(-1.0 / time_constant);
  Eigen::VectorXd past = Eigen::VectorXd::Zero(x.size());
  for (Eigen::Index t = 1; t < x.size(); ++t) past[t] = memory * past[t - 1] + x[t - 1];
  const double size = std::sqrt(past.squaredNorm() / static_cast<double>(past.size()));
  return size > 0.0 ? (past / size).cwiseMax(-kClippedAt).cwiseMin(kClippedAt) : past;
}

/// Constant, lags, weighted pasts as they are and saturated; then their squares, then their cubes;
/// then the innovations over their scale.
struct Columns {
  Eigen::MatrixXd linear;
  Eigen::MatrixXd tested;
};

Columns columns_of(std::span<const double> signal, const Innovations& innovations,
                   const Places& places) {
  const Eigen::VectorXd x = standardised(signal, innovations.model().mean());
  const Eigen::Index order = std::ssize(innovations.model().coefficients());
  Columns columns;
  columns.linear.resize(std::ssize(places), 1 + order + 2 * kPasts);
  columns.tested.resize(std::ssize(places), 2 * kPasts + 1);
  columns.linear.col(0).setOnes();
  for (Eigen::Index i = 0; i < order; ++i) {
    for (Eigen::Index n = 0; n < std::ssize(places); ++n) {
      columns.linear(n, 1 + i) = x[places[static_cast<std::size_t>(n)] - 1 - i];
    }
  }
  for (Eigen::Index j = 0; j < kPasts; ++j) {
    const Eigen::VectorXd past =
        weighted_past(x, kTimeConstants[static_cast<std::size_t>(j)])(places);
    columns.linear.col(1 + order + j) = past;
    columns.linear.col(1 + order + kPasts + j) = past.cwiseMax(-kTrusted).cwiseMin(kTrusted);
    columns.tested.col(j) = past.cwiseAbs2();
    columns.tested.col(kPasts + j) = past.array().cube();
  }
  for (Eigen::Index n = 0; n < std::ssize(places); ++n) {
    const auto t = static_cast<std::size_t>(places[static_cast<std::size_t>(n)]);
    columns.tested(n, 2 * kPasts) =
        std::clamp(innovations.values()[t] / innovations.scale()[t], -kClippedAt, kClippedAt);
  }
  return columns;
}

/// `tested` less what `linear` explains of it. Lags and weighted pasts say nearly the same:
/// pivoting drops what adds nothing.
void leave_residuals(Columns& columns) {
  const Eigen::MatrixXd products = columns.linear.transpose() * columns.linear;
  const Eigen::MatrixXd right = columns.linear.transpose() * columns.tested;
  const Eigen::MatrixXd weights = products.ldlt().solve(right);
  columns.tested.noalias() -= columns.linear * weights;
}

double score_p(const Eigen::VectorXd& u, const Eigen::VectorXd& g) {
  const double spread = std::sqrt((u.array() * g.array()).square().sum());
  if (!(spread > 0.0)) return 1.0;
  const double z = std::abs(u.dot(g)) / spread;
  return above_zero(2.0 * normal_upper(z));
}

double smallest_p(const Columns& columns, Eigen::Index first) {
  double smallest = 1.0;
  for (Eigen::Index j = first; j < first + kPasts; ++j) {
    smallest = std::min(smallest, score_p(columns.tested.col(2 * kPasts), columns.tested.col(j)));
  }
  return std::min(1.0, static_cast<double>(kPasts) * smallest);
}

}  // namespace

double InnovationTest::p() const {
  return std::min(1.0, 2.0 * std::min(even_p, odd_p));
}

InnovationTest test_innovations(std::span<const double> signal, const Innovations& innovations) {
  const Places places = known_places(innovations.values());
  const Eigen::Index columns_needed =
      1 + std::ssize(innovations.model().coefficients()) + 4 * kPasts;
  if (std::ssize(places) < kFewestPerColumn * columns_needed) return {};
  Columns columns = columns_of(signal, innovations, places);
  leave_residuals(columns);
  return {smallest_p(columns, 0), smallest_p(columns, kPasts)};
}

}  // namespace loopscope::core::hos
