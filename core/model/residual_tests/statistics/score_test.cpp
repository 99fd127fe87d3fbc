#include "core/model/residual_tests/statistics/score_test.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "core/hos/numeric/symmetric_eigen.hpp"
#include "core/model/residual_tests/statistics/tails.hpp"
#include "core/model/response/products.hpp"

namespace loopscope::core::model {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A direction with less than this share of the largest one's variance is rounding noise.
constexpr double kRankTolerance = 1e-10;

/// Of a few columns.
struct ScoreSums {
  explicit ScoreSums(Index columns)
      : before(VectorXd::Zero(columns)),
        after(VectorXd::Zero(columns)),
        score(VectorXd::Zero(columns)),
        variance(SumTable::Zero(columns, columns)) {}

  VectorXd before;  ///< squared length of each column
  VectorXd after;   ///< the same less what is known
  VectorXd score;
  SumTable variance;
};

/// Columns of which so many at a time ask a question of their own.
class GroupSums {
 public:
  GroupSums(Index columns, Index together) : together_(together) {
    for (Index first = 0; first < columns; first += together) groups_.emplace_back(together);
  }
  [[nodiscard]] const std::vector<ScoreSums>& groups() const { return groups_; }

  void add_before(const MatrixXd& z) {
    for_groups([&](ScoreSums& sums, Index first) {
      sums.before += z.middleCols(first, together_).colwise().squaredNorm();
    });
  }
  void add(MatrixXd& z, const Eigen::Ref<const VectorXd>& r) {
    for_groups([&](ScoreSums& sums, Index first) {
      auto own = z.middleCols(first, together_);
      sums.after += own.colwise().squaredNorm();
      own.array().colwise() *= r.array();
      sums.score += own.colwise().sum();
      const std::vector<Signal> columns = columns_of(own);
      add_products(columns, columns, {0, static_cast<std::size_t>(z.rows())}, sums.variance);
    });
  }

 private:
  template <class Work>
  void for_groups(Work work) {
    for (std::size_t i = 0; i < groups_.size(); ++i)
      work(groups_[i], static_cast<Index>(i) * together_);
  }

  Index together_;
  std::vector<ScoreSums> groups_;
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
  const MatrixXd variance =
      scale.asDiagonal() * MatrixXd(sums.variance) * scale.asDiagonal() / free;
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

/// What the columns explain of so many rows, off those.
void take_out(const std::vector<Signal>& columns, const MatrixXd& coefficients, MatrixXd& z) {
  std::vector<double*> from;
  for (Index j = 0; j < z.cols(); ++j) from.push_back(z.col(j).data());
  best_row_kernel().subtract(columns, coefficients.data(), static_cast<std::size_t>(z.rows()),
                             from);
}

}  // namespace

std::vector<Score> score_tests(const VectorXd& residual, const LaggedColumns& columns,
                               Index together, const LinearSpan& known,
                               const Eigen::ArrayXd& recorded) {
  SumTable products = SumTable::Zero(known.columns(), columns.columns());
  for_blocks(columns.rows(), [&](const Range& rows) {
    const MatrixXd z = columns.block(rows, recorded);
    add_products(columns_of(known.rows(rows)), columns_of(z), {0, rows.size()}, products);
  });
  const MatrixXd explained = known.coefficients(products);
  GroupSums sums(columns.columns(), together);
  for_blocks(columns.rows(), [&](const Range& rows) {
    MatrixXd z = columns.block(rows, recorded);
    sums.add_before(z);
    take_out(columns_of(known.rows(rows)), explained, z);
    sums.add(z, residual.segment(static_cast<Index>(rows.first), z.rows()));
  });
  const double free = 1.0 - static_cast<double>(known.rank()) / recorded.sum();
  std::vector<Score> scores;
  for (const ScoreSums& group : sums.groups()) scores.push_back(quadratic_form(group, free));
  return scores;
}

Score score_test(const VectorXd& residual, const LaggedColumns& columns, const LinearSpan& known,
                 const Eigen::ArrayXd& recorded) {
  if (columns.columns() == 0) return {};
  return score_tests(residual, columns, columns.columns(), known, recorded).front();
}

}  // namespace loopscope::core::model
