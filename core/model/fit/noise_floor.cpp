#include "core/model/fit/noise_floor.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

namespace loopscope::core::model {
namespace {

/// Lags of the innovations and of op's moves: beyond the memory of what real roots leave over.
constexpr std::size_t kOwnLags = 8;
constexpr std::size_t kOpLags = 8;
constexpr std::size_t kTerms = kOwnLags + kOpLags;

using TermsVector = Eigen::Matrix<double, kTerms, 1>;
using TermsMatrix = Eigen::Matrix<double, kTerms, kTerms>;

TermsVector past(const std::vector<double>& op, const std::vector<double>& r, std::size_t k) {
  TermsVector terms;
  for (std::size_t lag = 1; lag <= kOwnLags; ++lag) terms[static_cast<long>(lag - 1)] = r[k - lag];
  for (std::size_t lag = 1; lag <= kOpLags; ++lag) {
    terms[static_cast<long>(kOwnLags + lag - 1)] = op[k - lag] - op[k - lag - 1];
  }
  return terms;
}

}  // namespace

double noise_floor(const LoopData& data, const Fit& fit) {
  const std::vector<double> op = at_rows(data.grid, data.op);
  TermsMatrix normal = TermsMatrix::Zero();
  TermsVector right = TermsVector::Zero();
  for (const Range& range : data.rows.fit) {
    for (std::size_t k = std::max(range.first, kOwnLags + 1); k < range.end; ++k) {
      const TermsVector terms = past(op, fit.innovations, k);
      normal.selfadjointView<Eigen::Lower>().rankUpdate(terms);
      right += terms * fit.innovations[k];
    }
  }
  normal.diagonal() *= 1.0 + 1e-9;
  normal.diagonal().array() += 1e-300;
  const TermsVector weights =
      TermsMatrix(normal.selfadjointView<Eigen::Lower>()).ldlt().solve(right);
  double sum = 0.0;
  for (const Range& range : data.rows.score) {
    for (std::size_t k = std::max(range.first, kOwnLags + 1); k < range.end; ++k) {
      const double rest = fit.innovations[k] - weights.dot(past(op, fit.innovations, k));
      sum += rest * rest;
    }
  }
  const double error = sum / static_cast<double>(std::max<std::size_t>(1, data.rows.score_count()));
  return std::min(error, fit.score_error);
}

}  // namespace loopscope::core::model
