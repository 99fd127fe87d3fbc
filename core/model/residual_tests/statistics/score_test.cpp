#include "core/model/residual_tests/statistics/score_test.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "core/hos/numeric/symmetric_eigen.hpp"
#include "core/model/residual_tests/statistics/tails.hpp"

namespace loopscope::core::model {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A direction with less than this share of the largest one's variance is rounding noise.
constexpr double kRankTolerance = 1e-10;

template <class Work>
void for_blocks(Index rows, Work work) {
  for (Index row = 0; row < rows; row += kRowsTogether)
    work(row, std::min(kRowsTogether, rows - row));
}

struct ScoreSums {
  explicit ScoreSums(Index columns)
      : before(VectorXd::Zero(columns)),
        after(VectorXd::Zero(columns)),
        score(VectorXd::Zero(columns)),
        variance(MatrixXd::Zero(columns, columns)) {}

  void add(MatrixXd& z, const Eigen::Ref<const VectorXd>& r) {
    after += z.colwise().squaredNorm();
    score.noalias() += z.transpose() * r;
    z = r.asDiagonal() * z;
    variance.selfadjointView<Eigen::Lower>().rankUpdate(z.transpose());
  }

  VectorXd before;  ///< squared length of each column
  VectorXd after;   ///< the same less what is known
  VectorXd score;
  MatrixXd variance;  ///< lower triangle
};

/// One over the length of each column; 0 where nothing is left of it.
VectorXd scales(const ScoreSums& sums) {
  VectorXd scale(sums.after.size());
  for (Index j = 0; j < scale.size(); ++j)
    scale[j] = sums.after[j] > kLeastLeft * sums.before[j] ? 1.0 / std::sqrt(sums.after[j]) : 0.0;
  return scale;
}

/// `free` = share of the rows that the known columns leave: r is what a fit of them left, whose
/// squares are too small by that.
Score quadratic_form(const ScoreSums& sums, double free) {
  const VectorXd scale = scales(sums);
  const VectorXd score = scale.cwiseProduct(sums.score);
  const MatrixXd variance = scale.asDiagonal() * sums.variance * scale.asDiagonal() / free;
  Score result;
  result.t = VectorXd::Zero(score.size());
  for (Index j = 0; j < score.size(); ++j)
    if (variance(j, j) > 0.0) result.t[j] = score[j] / std::sqrt(variance(j, j));
  const hos::SymmetricEigen eigen = hos::symmetric_eigen(variance);
  const double least = kRankTolerance * eigen.values.tail(1)[0];
  double statistic = 0.0;
  for (Index j = 0; j < score.size(); ++j) {
    const double value = eigen.values[j];
    if (!(value > least)) continue;
    const double along = eigen.vectors.col(j).dot(score);
    statistic += along * along / value;
    ++result.freedom;
  }
  if (result.freedom > 0) result.p = chi_square_p(statistic, result.freedom);
  return result;
}

}  // namespace

Score score_test(const VectorXd& residual, const LaggedColumns& columns, const LinearSpan& known,
                 const Eigen::ArrayXd& recorded) {
  const auto block = [&](Index row, Index rows) -> MatrixXd {
    return recorded.segment(row, rows).matrix().asDiagonal() * columns.block(row, rows);
  };
  MatrixXd products = MatrixXd::Zero(known.columns(), columns.columns());
  for_blocks(columns.rows(), [&](Index row, Index rows) {
    products.noalias() += known.rows(row, rows).transpose() * block(row, rows);
  });
  const MatrixXd explained = known.coefficients(products);
  ScoreSums sums(columns.columns());
  for_blocks(columns.rows(), [&](Index row, Index rows) {
    MatrixXd z = block(row, rows);
    sums.before += z.colwise().squaredNorm();
    z.noalias() -= known.rows(row, rows) * explained;
    sums.add(z, residual.segment(row, rows));
  });
  return quadratic_form(sums, 1.0 - static_cast<double>(known.rank()) / recorded.sum());
}

}  // namespace loopscope::core::model
