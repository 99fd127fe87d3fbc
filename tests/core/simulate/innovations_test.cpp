#include "core/simulate/innovations.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace loopscope::core::simulate {
namespace {

constexpr std::size_t kDraws = 400'000;

double moment(const std::vector<double>& values, int order) {
  double sum = 0.0;
  for (const double value : values) {
    sum += std::pow(value, order);
  }
  return sum / static_cast<double>(values.size());
}

// Tolerances are four to five standard errors of a sample moment.
TEST(Innovations, HaveMeanZeroAndVarianceOne) {
  for (const auto law :
       {Innovation::gaussian, Innovation::exponential, Innovation::uniform, Innovation::laplace}) {
    const auto values = innovations(law, kDraws, 1);
    EXPECT_NEAR(moment(values, 1), 0.0, 0.007) << name(law);
    EXPECT_NEAR(moment(values, 2), 1.0, 0.02) << name(law);
  }
  for (const auto law : {Innovation::student_5, Innovation::student_3, Innovation::contaminated,
                         Innovation::bursts, Innovation::garch}) {
    const auto values = innovations(law, kDraws, 1);
    EXPECT_NEAR(moment(values, 1), 0.0, 0.01) << name(law);
    // The fourth moment is large (or none), and loudness lasts.
    EXPECT_NEAR(moment(values, 2), 1.0, 0.1) << name(law);
  }
}

TEST(Innovations, HaveTheShapeOfTheirLaw) {
  EXPECT_NEAR(moment(innovations(Innovation::exponential, kDraws, 2), 3), 2.0, 0.12);
  EXPECT_NEAR(moment(innovations(Innovation::uniform, kDraws, 2), 3), 0.0, 0.02);
  EXPECT_NEAR(moment(innovations(Innovation::uniform, kDraws, 2), 4), 1.8, 0.02);
  EXPECT_NEAR(moment(innovations(Innovation::laplace, kDraws, 2), 3), 0.0, 0.08);
  EXPECT_NEAR(moment(innovations(Innovation::laplace, kDraws, 2), 4), 6.0, 0.4);
  EXPECT_NEAR(moment(innovations(Innovation::gaussian, kDraws, 2), 4), 3.0, 0.08);
  // 3 (0.98 + 0.02 625) / 1.48^2 and 3 (0.9 + 0.1 625) / 3.4^2.
  EXPECT_NEAR(moment(innovations(Innovation::contaminated, kDraws, 2), 4), 18.5, 1.5);
  EXPECT_NEAR(moment(innovations(Innovation::bursts, kDraws, 2), 4), 16.5, 2.0);
  EXPECT_NEAR(moment(innovations(Innovation::student_5, kDraws, 2), 4), 9.0, 2.5);
}

TEST(Innovations, SameSeedSameNumbers) {
  for (const auto law : {Innovation::gaussian, Innovation::exponential, Innovation::uniform,
                         Innovation::laplace, Innovation::student_3, Innovation::student_5,
                         Innovation::contaminated, Innovation::bursts, Innovation::garch}) {
    EXPECT_EQ(innovations(law, 100, 3), innovations(law, 100, 3));
    EXPECT_NE(innovations(law, 100, 3), innovations(law, 100, 4));
  }
}

}  // namespace
}  // namespace loopscope::core::simulate
