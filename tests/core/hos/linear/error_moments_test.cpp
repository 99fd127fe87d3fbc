#include "core/hos/linear/error_moments.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "core/simulate/coloured_noise.hpp"
#include "tests/core/hos/signals.hpp"

namespace loopscope::core::hos {
namespace {

using simulate::Innovation;

TEST(ErrorMoments, OfTheSameErrorsDifferByChiSquared) {
  for (const Innovation law :
       {Innovation::gaussian, Innovation::laplace, Innovation::exponential}) {
    constexpr int kRecords = 400;
    double mean = 0.0;
    for (std::uint64_t seed = 1; seed <= kRecords; ++seed) {
      const ErrorMoments a(tests::coloured(law, 0.0, 2 * seed, 1024));
      const ErrorMoments b(tests::coloured(law, 0.0, 2 * seed + 1, 1024));
      mean += a.difference_from(b).chi_squared / kRecords;
    }
    // Five standard errors. The mean of each sub-window is scaled by its own spread.
    EXPECT_NEAR(mean, ErrorMoments::kCount, 5.0 * std::sqrt(18.0 / kRecords)) << name(law);
  }
}

TEST(ErrorMoments, OfOtherCorrelationsDiffer) {
  const ErrorMoments white(tests::coloured(Innovation::gaussian, 0.0, 1, 2048));
  const ErrorMoments red(tests::coloured(Innovation::gaussian, 0.5, 2, 2048));
  const ErrorMoments::Difference difference = white.difference_from(red);
  EXPECT_GT(difference.chi_squared, 100.0);
  EXPECT_NEAR(difference.size, 0.33, 0.1);  // 0.5^2 + 0.25^2 + ...
}

TEST(ErrorMoments, LoudnessDoesNotCount) {
  std::vector<double> errors = tests::coloured(Innovation::gaussian, 0.0, 1, 512);
  const ErrorMoments quiet(errors);
  for (double& error : errors) error *= 1e9;
  EXPECT_NEAR(quiet.difference_from(ErrorMoments(errors)).chi_squared, 0.0, 1e-9);
}

TEST(ErrorMoments, NothingToCompareIsNoDifference) {
  const ErrorMoments some(tests::coloured(Innovation::gaussian, 0.0, 1, 512));
  for (const auto& errors : {std::vector<double>{}, std::vector<double>(100, 0.0),
                             std::vector<double>(100, std::numeric_limits<double>::quiet_NaN())}) {
    const ErrorMoments::Difference difference = some.difference_from(ErrorMoments(errors));
    EXPECT_TRUE(std::isfinite(difference.chi_squared));
    EXPECT_TRUE(std::isfinite(difference.size));
  }
}

TEST(ErrorMoments, AddUp) {
  const std::vector<double> errors = tests::coloured(Innovation::gaussian, 0.0, 3, 512);
  ErrorMoments sum;
  sum += ErrorMoments(errors);
  sum += ErrorMoments(errors);
  EXPECT_NEAR(sum.difference_from(ErrorMoments(errors)).size, 0.0, 1e-20);
}

}  // namespace
}  // namespace loopscope::core::hos
