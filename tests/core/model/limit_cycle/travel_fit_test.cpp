#include "core/model/limit_cycle/travel_fit.hpp"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>
#include <random>

namespace loopscope::core::model {
namespace {

bool is_fitted(std::size_t k) {
  return k / 6 % 2 == 0;
}

/// One less the mean square left by the variance, over the means of one kind.
double share(const std::vector<double>& pv, const std::vector<double>& model, bool fitted) {
  double left = 0.0, sum = 0.0, square = 0.0, count = 0.0;
  for (std::size_t k = 0; k < pv.size(); ++k) {
    if (is_fitted(k) != fitted) continue;
    left += (pv[k] - model[k]) * (pv[k] - model[k]);
    sum += pv[k];
    square += pv[k] * pv[k];
    count += 1.0;
  }
  return 1.0 - left / (square - sum * sum / count);
}

/// Every lag and delay, one after the other, by the rows.
TravelShare plainly(const std::vector<double>& pv, const std::vector<double>& flow) {
  TravelShare best;
  for (const double pole : {0.0, 0.6, 0.85, 0.95, 0.99}) {
    for (const std::size_t delay : {0U, 1U, 3U}) {
      const std::vector<TravelRow> rows = travel_rows(flow, pole, delay);
      Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
      Eigen::Vector3d right = Eigen::Vector3d::Zero();
      for (std::size_t k = 0; k < pv.size(); ++k) {
        if (!is_fitted(k)) continue;
        const Eigen::Vector3d row(rows[k].data());
        normal += row * row.transpose();
        right += row * pv[k];
      }
      const Eigen::Vector3d w = normal.ldlt().solve(right);
      std::vector<double> model;
      for (const TravelRow& row : rows)
        model.push_back(row[0] * w[0] + (row[1] * w[1] + row[2] * w[2]));
      const double fitted = share(pv, model, true);
      if (fitted > best.fitted)
        best = {fitted, share(pv, model, false), {pole, delay, {w[0], w[1], w[2]}}};
    }
  }
  return best;
}

TEST(TravelFit, EqualsTheFitOfEveryLagToTheLastDigit) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (int record = 0; record < 200; ++record) {
    std::vector<double> flow(40 + 5 * static_cast<std::size_t>(record)), pv(flow.size());
    double level = normal(random), lagged = level;
    for (std::size_t k = 0; k < flow.size(); ++k) {
      flow[k] = level += normal(random);
      lagged += 0.2 * (flow[k] - lagged);
      pv[k] = 100.0 * (record % 3) + lagged + (record % 7) * normal(random);
    }
    const TravelShare expected = plainly(pv, flow);
    const TravelFit fit(pv);
    const LaggedFlows flows = fit.lag(eight_times(flow));
    const TravelShare found = fit.best(flows, 0);
    EXPECT_EQ(found.fitted, expected.fitted);
    EXPECT_EQ(found.scored, expected.scored);
    EXPECT_EQ(found.model.pole, expected.model.pole);
    EXPECT_EQ(found.model.delay, expected.model.delay);
    EXPECT_EQ(found.model.weights, expected.model.weights);
    EXPECT_EQ(fit.best(flows, 7, expected.fitted).fitted, expected.fitted) << "beats itself";
  }
}

TEST(TravelFit, KnowsNothingOfAFlowThatRests) {
  const std::vector<double> flow(60, 3.0);
  std::vector<double> pv(60);
  for (std::size_t k = 0; k < pv.size(); ++k) pv[k] = static_cast<double>(k % 5);
  const TravelFit fit(pv);
  EXPECT_EQ(fit.best(fit.lag(eight_times(flow)), 0).fitted, -1.0);
}

}  // namespace
}  // namespace loopscope::core::model
