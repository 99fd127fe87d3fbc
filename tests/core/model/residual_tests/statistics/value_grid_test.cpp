#include "core/model/residual_tests/statistics/value_grid.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/core/model/residual_tests/loops.hpp"

namespace loopscope::core::model {
namespace {

using tests::Series;

Series rounded(Series values, double step, double rounding = 0.0) {
  const Series noise = tests::white(tests::White::gaussian, values.size(), 99);
  for (std::size_t k = 0; k < values.size(); ++k)
    values[k] = step * std::round(values[k] / step) + rounding * noise[k];
  return values;
}

TEST(ValueGrid, StepIsExact) {
  const Series noise = tests::white(tests::White::gaussian, 4096, 1);
  for (const double step : {0.15, 0.3, 1.0, 2.5}) {
    for (const double rounding : {0.0, 1e-9}) {
      const ValueGrid grid = find_grid(rounded(noise, step, rounding), 1.0);
      EXPECT_NEAR(grid.step / step, 1.0, 1e-4) << step;
      EXPECT_LT(grid.p, 1e-50) << step;
    }
  }
}

TEST(ValueGrid, AFewInterpolatedValuesDoNoHarm) {
  Series values = rounded(tests::white(tests::White::gaussian, 4096, 2), 0.4);
  for (std::size_t k = 5; k < values.size(); k += 50) values[k] += 0.1234 * double(k) / 4096.0;
  EXPECT_NEAR(find_grid(values, 1.0).step, 0.4, 1e-3);
}

TEST(ValueGrid, ContinuousValuesHaveNone) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed)
    EXPECT_EQ(find_grid(tests::white(tests::White::laplace, 1000, seed), 1.0).step, 0.0);
}

TEST(ValueGrid, HeldValuesHaveNone) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Series held = tests::white(tests::White::gaussian, 4000, seed);
    for (std::size_t k = 0; k < held.size(); ++k) held[k] = held[k / 10 * 10];
    EXPECT_GT(find_grid(held, 1.0).p, 0.05);
  }
}

}  // namespace
}  // namespace loopscope::core::model
