#include "core/model/controller/shared_moves.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/model/controller/octave_power.hpp"

namespace loopscope::core::model {
namespace {

/// Fewer moves than this leave too little beside three coefficients.
constexpr std::size_t kLeastMoves = 24;

std::vector<double> moves(const std::vector<double>& blocks) {
  std::vector<double> result(blocks.size() - 1);
  for (std::size_t k = 0; k < result.size(); ++k) result[k] = blocks[k + 1] - blocks[k];
  return result;
}

struct Shared {
  double r_squared = 0.0;
  double count = 0.0;
};

Shared shared_at(const std::vector<double>& cause, const std::vector<double>& answer) {
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Eigen::Vector3d cross = Eigen::Vector3d::Zero();
  double total = 0.0, count = 0.0;
  for (std::size_t k = 1; k + 1 < cause.size(); ++k) {
    const Eigen::Vector3d x(cause[k - 1], cause[k], cause[k + 1]);
    if (!x.allFinite() || !std::isfinite(answer[k])) continue;
    squares.noalias() += x * x.transpose();
    cross.noalias() += x * answer[k];
    total += answer[k] * answer[k];
    count += 1.0;
  }
  if (count < static_cast<double>(kLeastMoves) || !(total > 0.0)) return {};
  const Eigen::Vector3d c = squares.ldlt().solve(cross);
  if (!c.allFinite()) return {};
  return {std::clamp(c.dot(cross) / total, 0.0, 1.0), count};
}

}  // namespace

SharedMoves find_shared_moves(std::span<const double> cause, std::span<const double> answer) {
  std::vector<double> one(cause.begin(), cause.end());
  std::vector<double> other(answer.begin(), answer.end());
  SharedMoves found;
  for (; one.size() > kLeastMoves + 2; one = halved(one), other = halved(other)) {
    const Shared shared = shared_at(moves(one), moves(other));
    ++found.scales;
    if (shared.r_squared * shared.count <= found.chi_squared) continue;
    found.r_squared = shared.r_squared;
    found.chi_squared = shared.r_squared * shared.count;
  }
  return found;
}

}  // namespace loopscope::core::model
