#include "core/model/lagged_fit.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "core/model/lagged_rows.hpp"
#include "core/simulate/random.hpp"

namespace loopscope::core::model {
namespace {

struct LaggedRecord {
  std::vector<double> pv, mv;
  std::vector<std::uint8_t> fit, known;
};

/// pv(k) = 0.8 pv(k-1) + 0.5 mv(k-3) + noise, with gaps in pv and blocks left out of the fit.
LaggedRecord lagged_record(double noise_std) {
  simulate::GaussianSource noise(11);
  LaggedRecord r;
  for (std::size_t k = 0; k < 900; ++k) {
    r.mv.push_back(noise.next());
    const double past = k > 0 ? 0.8 * r.pv[k - 1] : 0.0;
    const double push = k > 2 ? 0.5 * r.mv[k - 3] : 0.0;
    r.pv.push_back(past + push + noise_std * noise.next());
    r.fit.push_back((k / 100) % 3 == 1 ? 0 : 1);
    r.known.push_back(1);
  }
  return r;
}

TEST(LaggedFit, FindsTheProcess) {
  const LaggedRecord r = lagged_record(1e-3);
  const LaggedModel model = fit_lagged(lagged_rows(r.pv, r.fit, r.known, 1), r.mv);
  EXPECT_NEAR(model.weights[kOutputLags + 3], 0.5, 1e-3);
  EXPECT_NEAR(model.weights[kOutputLags + 1], 0.0, 1e-3);
}

TEST(LaggedFit, IsTheLeastSquaresFitOfTheRows) {
  LaggedRecord r = lagged_record(0.3);
  for (std::size_t k = 200; k < 215; ++k) {
    r.pv[k] = std::numeric_limits<double>::quiet_NaN();
  }
  r.known[500] = 0;
  const LaggedRows rows = lagged_rows(r.pv, r.fit, r.known, 1);
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(rows.rows), kLaggedColumns);
  Eigen::VectorXd target(columns.rows());
  Eigen::Index row = 0;
  for (std::size_t k = 0; k < rows.output.size(); ++k) {
    if (rows.counted[k] == 0) {
      continue;
    }
    target(row) = rows.output[k];
    for (std::size_t i = 1; i <= kOutputLags; ++i) {
      columns(row, static_cast<Eigen::Index>(i - 1)) = rows.output[k - i];
    }
    columns(row, kOutputLags) = 1.0;
    for (std::size_t i = 1; i <= kInputLags; ++i) {
      columns(row, static_cast<Eigen::Index>(kOutputLags + i)) = r.mv[k - i];
    }
    ++row;
  }
  const Eigen::VectorXd exact = columns.colPivHouseholderQr().solve(target);
  const LaggedModel model = fit_lagged(rows, r.mv);
  EXPECT_NEAR(model.residual, (target - columns * exact).squaredNorm(), 1e-7);
  for (std::size_t i = 0; i < kLaggedColumns; ++i) {
    EXPECT_NEAR(model.weights[i], exact(static_cast<Eigen::Index>(i)), 1e-6) << i;
  }
}

TEST(LaggedFit, LeavesOutWhatTouchesAGap) {
  LaggedRecord r = lagged_record(0.3);
  std::fill(r.fit.begin(), r.fit.end(), std::uint8_t{1});
  const std::size_t whole = lagged_rows(r.pv, r.fit, r.known, 1).rows;
  r.pv[400] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(lagged_rows(r.pv, r.fit, r.known, 1).rows, whole - 1 - kOutputLags);
  r.pv[400] = 0.0;
  r.known[400] = 0;
  EXPECT_EQ(lagged_rows(r.pv, r.fit, r.known, 1).rows, whole - kInputLags);
}

TEST(LaggedFit, BearsAnInputMadeOfPv) {
  LaggedRecord r = lagged_record(0.3);
  std::vector<double> op(r.pv.size(), 0.0);
  for (std::size_t k = 1; k < op.size(); ++k) {
    op[k] = op[k - 1] - 0.3 * (r.pv[k] - r.pv[k - 1]) - 0.1 * r.pv[k];
  }
  const LaggedModel model = fit_lagged(lagged_rows(r.pv, r.fit, r.known, 1), op);
  EXPECT_TRUE(std::isfinite(model.residual));
  EXPECT_GT(model.residual, 0.0);
  for (const double weight : model.weights) {
    EXPECT_LT(std::abs(weight), 1e3);
  }
}

}  // namespace
}  // namespace loopscope::core::model
