#include "core/hos/linear/prediction_errors.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace loopscope::core::hos {
namespace {

const std::vector<double> kCoefficients = {1.5, -0.8};

std::vector<double> record() {
  std::vector<double> x;
  for (int t = 0; t < 60; ++t) x.push_back(std::sin(0.7 * t) + 0.3 * std::cos(2.1 * t * t));
  x[30] = std::numeric_limits<double>::quiet_NaN();
  return x;
}

/// Half the sum of squares of all errors that the samples of a run enter, from the definition.
double half_sum(const std::vector<double>& x, std::size_t first, std::size_t last) {
  double sum = 0.0;
  const auto add = [&](double error) { sum += std::isfinite(error) ? 0.5 * error * error : 0.0; };
  for (std::size_t t = 2; t < x.size(); ++t) {
    if (t - 2 <= last && t >= first) add(x[t] - 1.5 * x[t - 1] + 0.8 * x[t - 2]);
  }
  for (const std::size_t t : {0U, 1U, 31U, 32U}) {
    if (t <= last && t + 2 >= first) add(x[t] - 1.5 * x[t + 1] + 0.8 * x[t + 2]);
  }
  return sum;
}

TEST(PredictionErrors, ExpandIsTheDerivativeOfTheSumOfSquares) {
  for (const std::size_t first : {0U, 1U, 10U, 29U, 31U, 33U, 58U}) {
    const std::size_t count = first == 29U ? 1 : 2;
    std::vector<double> x = record();
    const PredictionErrors errors(x, kCoefficients, 0.0);
    Eigen::VectorXd gradient(count);
    Eigen::MatrixXd curvature(count, count);
    errors.expand(first, gradient, curvature);
    const double before = half_sum(x, first, first + count - 1);
    x[first] += 0.5;
    const double after = half_sum(x, first, first + count - 1);
    EXPECT_NEAR(after - before, 0.5 * gradient[0] + 0.125 * curvature(0, 0), 1e-12) << first;
    if (count == 1) continue;
    // From there the second sample too: its own terms, and the one that both share.
    x[first + 1] -= 0.25;
    const double both = half_sum(x, first, first + count - 1);
    EXPECT_NEAR(both - after,
                -0.25 * (gradient[1] + 0.5 * curvature(1, 0)) + 0.03125 * curvature(1, 1), 1e-12)
        << first;
  }
}

TEST(PredictionErrors, AChangeIsFollowed) {
  std::vector<double> x = record();
  PredictionErrors followed(x, kCoefficients, 0.0);
  Eigen::VectorXd change(2);
  change << 0.5, -0.25;
  for (const std::size_t first : {0U, 10U, 31U, 58U}) {
    followed.change(first, change);
    x[first] += 0.5;
    x[first + 1] -= 0.25;
  }
  const PredictionErrors anew(x, kCoefficients, 0.0);
  EXPECT_NEAR(followed.variance(), anew.variance(), 1e-12);
  Eigen::VectorXd gradient(2), expected(2);
  Eigen::MatrixXd curvature(2, 2);
  followed.expand(1, gradient, curvature);
  anew.expand(1, expected, curvature);
  EXPECT_NEAR((gradient - expected).norm(), 0.0, 1e-12);
}

TEST(PredictionErrors, WithoutRoomThereAreNone) {
  const std::vector<double> two = {1.0, 2.0};
  EXPECT_EQ(PredictionErrors(two, kCoefficients, 0.0).variance(), 0.0);
}

}  // namespace
}  // namespace loopscope::core::hos
