#include "core/model/response/products.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace loopscope::core::model {
namespace {

double sum_of_products(Signal left, Signal right, const std::vector<Range>& rows) {
  double sum = 0.0;
  for (const Range& range : rows) {
    for (std::size_t k = range.first; k < range.end; ++k) sum += left[k] * right[k];
  }
  return sum;
}

void expect_sums(const Eigen::MatrixXd& found, const std::vector<Signal>& left,
                 const std::vector<Signal>& right, const std::vector<Range>& rows) {
  for (std::size_t i = 0; i < left.size(); ++i) {
    for (std::size_t j = 0; j < right.size(); ++j) {
      const double sum = sum_of_products(left[i], right[j], rows);
      EXPECT_NEAR(found(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)), sum, 1e-12);
    }
  }
}

TEST(Products, AreTheSumsOverTheRows) {
  constexpr std::size_t kSamples = 100;
  std::vector<std::vector<double>> signals(5, std::vector<double>(kSamples));
  std::vector<Signal> all;
  for (std::size_t s = 0; s < signals.size(); ++s) {
    for (std::size_t k = 0; k < kSamples; ++k) {
      signals[s][k] = std::cos(0.3 * static_cast<double>((s + 1) * k) + static_cast<double>(s));
    }
    all.push_back(signals[s].data());
  }
  const std::vector<Range> rows = {{3, 4}, {10, 18}, {20, 61}, {70, 70}};
  const std::vector<Signal> few(all.begin(), all.begin() + 3);
  const Eigen::MatrixXd square = products(all, rows);
  const Eigen::MatrixXd crossed = products(few, all, rows);
  expect_sums(square, all, all, rows);
  expect_sums(crossed, few, all, rows);
  for (const Signal& signal : all) {
    EXPECT_NEAR(sum_of_squares(signal, rows), sum_of_products(signal, signal, rows), 1e-12);
  }
}

/// Zeros at the ends of a signal are passed over, also where two signals never meet.
TEST(Products, OfSignalsThatSitInOnePlaceAreTheSame) {
  constexpr std::size_t kSamples = 200;
  const std::vector<Range> rows = {{5, 40}, {44, 90}, {95, 160}, {170, 198}};
  std::vector<std::vector<double>> signals(5, std::vector<double>(kSamples));
  const std::vector<Range> places = {{0, 200}, {50, 80}, {100, 175}, {0, 30}, {0, 0}};
  std::vector<Signal> all;
  for (std::size_t s = 0; s < signals.size(); ++s) {
    for (std::size_t k = places[s].first; k < places[s].end; ++k)
      signals[s][k] = std::cos(0.7 * static_cast<double>((s + 1) * k));
    all.push_back(signals[s].data());
  }
  const Eigen::MatrixXd square = products(all, rows);
  const Eigen::MatrixXd crossed = products(all, all, rows);
  expect_sums(square, all, all, rows);
  expect_sums(crossed, all, all, rows);
}

}  // namespace
}  // namespace loopscope::core::model
