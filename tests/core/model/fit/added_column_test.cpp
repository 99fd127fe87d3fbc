#include "core/model/fit/added_column.hpp"

#include <gtest/gtest.h>

#include "core/model/fit/newton_step.hpp"
#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Products of pv, some regressors and the added one last, all of white noise.
MatrixXd normal_of(std::size_t regressors) {
  constexpr std::size_t kSamples = 200;
  MatrixXd table(kSamples, static_cast<Eigen::Index>(regressors + 2));
  for (Eigen::Index at = 0; at < table.cols(); ++at) {
    const tests::Series noise = tests::white_noise(kSamples, static_cast<std::uint64_t>(at + 1));
    table.col(at) = VectorXd::Map(noise.data(), kSamples);
  }
  table.col(0) += 2.0 * table.rightCols(1);
  return table.transpose() * table;
}

double solved(const MatrixXd& normal) {
  const Eigen::Index terms = normal.rows() - 1;
  const MatrixXd regressors = normal.bottomRightCorner(terms, terms);
  const VectorXd right = normal.col(0).tail(terms);
  const VectorXd coefficients = solve_normal(regressors, right);
  return normal(0, 0) + coefficients.dot(regressors * coefficients - 2.0 * right);
}

double added(const MatrixXd& normal) {
  const Eigen::Index steady = normal.rows() - 1;
  const tests::Series moved(normal.col(steady).begin(), normal.col(steady).end());
  return AddedColumn(normal.topLeftCorner(steady, steady)).squares_left(moved);
}

TEST(AddedColumn, LeavesWhatAllOfThemLeave) {
  for (std::size_t regressors = 0; regressors < 6; ++regressors) {
    const MatrixXd normal = normal_of(regressors);
    EXPECT_NEAR(added(normal), solved(normal), 1e-9 * solved(normal)) << regressors;
  }
}

/// A valve that never moves is the offset once more.
TEST(AddedColumn, ThatIsOneOfTheOthersTakesNothing) {
  MatrixXd normal = normal_of(3);
  normal.row(4) = 2.0 * normal.row(2);
  normal.col(4) = 2.0 * normal.col(2);
  EXPECT_NEAR(added(normal), solved(normal), 1e-7 * solved(normal));
}

TEST(AddedColumn, OfNothingTakesNothing) {
  MatrixXd normal = normal_of(2);
  normal.row(3).setZero();
  normal.col(3).setZero();
  EXPECT_NEAR(added(normal), solved(normal), 1e-9 * solved(normal));
}

}  // namespace
}  // namespace loopscope::core::model
