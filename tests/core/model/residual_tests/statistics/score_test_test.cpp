#include "core/model/residual_tests/statistics/score_test.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>

#include "tests/core/model/residual_tests/loops.hpp"

namespace loopscope::core::model {
namespace {

using tests::Series;
using tests::White;

struct Regression {
  explicit Regression(std::size_t samples)
      : weights(Eigen::ArrayXd::Ones(static_cast<long>(samples))) {}
  [[nodiscard]] Score test(const Series& r, const LaggedColumns& columns) const {
    const LinearSpan constant(LaggedColumns(r.size()), weights);
    return score_test(constant.without(r), columns, constant, weights);
  }
  Eigen::ArrayXd weights;
};

TEST(ScoreTest, OneColumnIsItsStudentisedSum) {
  const std::size_t n = 700;  // not a multiple of the block
  const Series r = tests::white(White::gaussian, n, 1), z = tests::white(White::laplace, n, 2);
  LaggedColumns columns(n);
  columns.add(z, std::array{0});
  const Score score = Regression(n).test(r, columns);

  double r_mean = 0.0, z_mean = 0.0, sum = 0.0, squares = 0.0;
  for (std::size_t k = 0; k < n; ++k) r_mean += r[k] / double(n), z_mean += z[k] / double(n);
  for (std::size_t k = 0; k < n; ++k) {
    const double product = (r[k] - r_mean) * (z[k] - z_mean);
    sum += product;
    squares += product * product;
  }
  EXPECT_EQ(score.freedom, 1U);
  EXPECT_NEAR(score.t[0], sum / std::sqrt(squares * double(n) / double(n - 1)), 1e-10);
  EXPECT_NEAR(score.p, std::erfc(std::abs(score.t[0]) / std::sqrt(2.0)), 1e-10);
}

/// Neither the span nor the test takes the rounding that is left of a known column for news.
TEST(ScoreTest, WhatIsKnownButForRoundingAddsNothing) {
  const std::size_t n = 700;
  const Series r = tests::white(White::gaussian, n, 1), z = tests::white(White::laplace, n, 2);
  Series near(z);
  for (std::size_t k = 0; k < n; ++k) near[k] += 1e-6 * z[n - 1 - k];  // a share of 1e-12
  const Eigen::ArrayXd recorded = Eigen::ArrayXd::Ones(static_cast<long>(n));
  LaggedColumns known(n), columns(n);
  known.add(z, std::array{0});
  columns.add(near, std::array{0});
  const LinearSpan span(known, recorded);
  EXPECT_EQ(score_test(span.without(r), columns, span, recorded).freedom, 0U);
}

TEST(ScoreTest, LagsLookBack) {
  const std::size_t n = 1000;
  const Series z = tests::white(White::gaussian, n, 3);
  Series r(n, 0.0);
  for (std::size_t k = 4; k < n; ++k) r[k] = z[k - 4];
  LaggedColumns columns(n);
  columns.add(z, std::array{3, 4, 5});
  const Score score = Regression(n).test(r, columns);
  // s'V^-1 s = n / E z^4 = n / 3 for r = z, Gaussian.
  EXPECT_LT(score.p, 1e-50);
  EXPECT_GT(score.t[1], 5.0 * std::abs(score.t[0]));
  const Eigen::MatrixXd block = columns.block({2, 6}, Eigen::ArrayXd::Ones(static_cast<long>(n)));
  EXPECT_EQ(block(0, 0), 0.0);
  EXPECT_EQ(block(1, 0), z[0]);
}

TEST(ScoreTest, RepeatedAndConstantColumnsAddNothing) {
  const std::size_t n = 500;
  const Series r = tests::white(White::gaussian, n, 4), z = tests::white(White::gaussian, n, 5);
  const Series constant(n, 3.0);
  LaggedColumns one(n), three(n), none(n);
  one.add(z, std::array{0});
  three.add(z, std::array{0, 0});
  three.add(constant, std::array{0});
  none.add(constant, std::array{0});
  EXPECT_EQ(Regression(n).test(r, three).freedom, 1U);
  EXPECT_NEAR(Regression(n).test(r, three).p, Regression(n).test(r, one).p, 1e-9);
  EXPECT_EQ(Regression(n).test(r, none).freedom, 0U);
  EXPECT_EQ(Regression(n).test(r, none).p, 1.0);
}

TEST(ScoreTest, OneOutlierProvesNothing) {
  const std::size_t n = 500;
  Series r = tests::white(White::gaussian, n, 6), z = tests::white(White::gaussian, n, 7);
  r[100] = z[100] = 1e6;
  LaggedColumns columns(n);
  columns.add(z, std::array{0});
  EXPECT_GT(Regression(n).test(r, columns).p, 0.3);
}

}  // namespace
}  // namespace loopscope::core::model
