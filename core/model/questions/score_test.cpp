#include "core/model/questions/score_test.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/hos/symmetric_eigen.hpp"
#include "core/model/questions/tails.hpp"

namespace loopscope::core::model {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A direction with less than this share of the largest one's variance is rounding noise.
constexpr double kRankTolerance = 1e-10;

MatrixXd gram(const MatrixXd& columns) {
  MatrixXd product = MatrixXd::Zero(columns.cols(), columns.cols());
  product.selfadjointView<Eigen::Lower>().rankUpdate(columns.transpose());
  return product;
}

/// Share of a column's squared length below which nothing but rounding is left of it.
constexpr double kVanished = 1e-12;

/// Rows that are worked on at a time: twenty columns of them stay in the processor's cache.
constexpr Index kBlock = 256;

template <class Work>
void for_blocks(Index rows, Work work) {
  for (Index row = 0; row < rows; row += kBlock) work(row, std::min(kBlock, rows - row));
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
    scale[j] = sums.after[j] > kVanished * sums.before[j] ? 1.0 / std::sqrt(sums.after[j]) : 0.0;
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
  if (result.freedom > 0) result.p = chi_square_upper(statistic, result.freedom);
  return result;
}

/// The directions that the columns span, each of length 1.
MatrixXd orthonormalised(MatrixXd weighted) {
  for (Index j = 0; j < weighted.cols(); ++j) weighted.col(j).stableNormalize();
  const hos::SymmetricEigen eigen = hos::symmetric_eigen(gram(weighted));
  const double largest = eigen.values.tail(1)[0];
  MatrixXd turn(weighted.cols(), 0);
  for (Index j = 0; j < weighted.cols(); ++j) {
    const double value = eigen.values[j];
    if (!(value > kRankTolerance * largest)) continue;
    turn.conservativeResize(Eigen::NoChange, turn.cols() + 1);
    turn.rightCols(1) = eigen.vectors.col(j) / std::sqrt(value);
  }
  return weighted * turn;
}

}  // namespace

void LaggedColumns::add(std::span<const double> signal, std::span<const int> lags) {
  for (const int lag : lags) columns_.push_back({signal, lag});
}

MatrixXd LaggedColumns::block(Index first_row, Index rows) const {
  MatrixXd result(rows, columns());
  for (Index j = 0; j < columns(); ++j) {
    const auto& [signal, lag] = columns_[static_cast<std::size_t>(j)];
    const Index zeros = std::clamp(lag - first_row, Index{0}, rows);
    result.col(j).head(zeros).setZero();
    std::copy_n(signal.data() + (first_row + zeros - lag), rows - zeros,
                result.col(j).data() + zeros);
  }
  return result;
}

MatrixXd orthonormal(const LaggedColumns& columns, const Eigen::ArrayXd& weights) {
  MatrixXd weighted(columns.rows(), columns.columns() + 1);
  weighted.col(0) = weights.matrix();
  weighted.rightCols(columns.columns()) =
      weights.matrix().asDiagonal() * columns.block(0, columns.rows());
  return orthonormalised(std::move(weighted));
}

MatrixXd orthonormal(const MatrixXd& known, const LaggedColumns& columns,
                     const Eigen::ArrayXd& weights) {
  MatrixXd rest = weights.matrix().asDiagonal() * columns.block(0, columns.rows());
  const VectorXd before = rest.colwise().squaredNorm();
  rest -= known * (known.transpose() * rest);
  for (Index j = 0; j < rest.cols(); ++j)
    if (rest.col(j).squaredNorm() <= kVanished * before[j]) rest.col(j).setZero();
  MatrixXd more = orthonormalised(std::move(rest));
  // Of a column that is nearly known, little is left, and rounding in it.
  more -= known * (known.transpose() * more);
  MatrixXd result(known.rows(), known.cols() + more.cols());
  result << known, more;
  return result;
}

VectorXd without(const MatrixXd& known, std::span<const double> residual) {
  VectorXd r = Eigen::Map<const VectorXd>(residual.data(), static_cast<Index>(residual.size()));
  r -= known * (known.transpose() * r);
  return r;
}

Score score_test(const VectorXd& residual, const LaggedColumns& columns, const MatrixXd& known,
                 const Eigen::ArrayXd& weights) {
  const auto weighted = [&](Index row, Index rows) -> MatrixXd {
    return weights.segment(row, rows).matrix().asDiagonal() * columns.block(row, rows);
  };
  MatrixXd explained = MatrixXd::Zero(known.cols(), columns.columns());
  for_blocks(columns.rows(), [&](Index row, Index rows) {
    explained.noalias() += known.middleRows(row, rows).transpose() * weighted(row, rows);
  });
  ScoreSums sums(columns.columns());
  for_blocks(columns.rows(), [&](Index row, Index rows) {
    MatrixXd z = weighted(row, rows);
    sums.before += z.colwise().squaredNorm();
    z.noalias() -= known.middleRows(row, rows) * explained;
    sums.add(z, residual.segment(row, rows));
  });
  return quadratic_form(sums, 1.0 - static_cast<double>(known.cols()) / weights.sum());
}

}  // namespace loopscope::core::model
