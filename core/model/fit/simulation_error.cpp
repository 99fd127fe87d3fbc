#include "core/model/fit/simulation_error.hpp"

#include <Eigen/Cholesky>

namespace loopscope::core::model {
namespace {

constexpr int kDriftTerms = 4;
using DriftVector = Eigen::Matrix<double, kDriftTerms, 1>;
using DriftMatrix = Eigen::Matrix<double, kDriftTerms, kDriftTerms>;

DriftVector drift_at(std::size_t k, std::size_t n) {
  const double t = 2.0 * static_cast<double>(k) / static_cast<double>(n) - 1.0;
  return {1.0, t, t * t, t * t * t};
}

DriftVector drift_of(const std::vector<double>& left, const std::vector<Range>& rows) {
  DriftMatrix normal = DriftMatrix::Zero();
  DriftVector right = DriftVector::Zero();
  for (const Range& range : rows) {
    for (std::size_t k = range.first; k < range.end; ++k) {
      const DriftVector terms = drift_at(k, left.size());
      normal += terms * terms.transpose();
      right += terms * left[k];
    }
  }
  return normal.ldlt().solve(right);
}

}  // namespace

std::vector<double> simulation_residual(const LoopData& data, const Fit& fit) {
  std::vector<double> left = deterministic_output(data, fit);
  for (std::size_t k = 0; k < left.size(); ++k) left[k] = data.pv[k] - left[k];
  const DriftVector drift = drift_of(left, data.rows.fit);
  for (std::size_t k = 0; k < left.size(); ++k) left[k] -= drift.dot(drift_at(k, left.size()));
  return left;
}

double simulation_error(const LoopData& data, const Fit& fit) {
  const std::vector<double> left = simulation_residual(data, fit);
  double sum = 0.0;
  for (const Range& range : data.rows.score) {
    for (std::size_t k = range.first; k < range.end; ++k) sum += left[k] * left[k];
  }
  return sum / static_cast<double>(std::max<std::size_t>(1, data.rows.score_count()));
}

}  // namespace loopscope::core::model
