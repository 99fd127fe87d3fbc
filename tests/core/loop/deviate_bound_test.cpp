#include "core/loop/deviate_bound.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "core/hos/numeric/distributions.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::loop {
namespace {

/// Calls `use(ratio, freedom_1, freedom_2)` for deviates from about -8 to 8.
template <typename Use>
void each_ratio(Use use) {
  for (double freedom_1 = 2.0; freedom_1 < 2e4; freedom_1 *= 1.3) {
    for (double freedom_2 = 4.0; freedom_2 < 2e4; freedom_2 *= 1.3) {
      const double step = 0.1 * std::sqrt(2.0 / freedom_1 + 2.0 / freedom_2);
      for (int k = -80; k <= 80; ++k) use(std::exp(k * step), freedom_1, freedom_2);
    }
  }
}

TEST(DeviateBound, IsNeverBelowTheDeviate) {
  each_ratio([](double ratio, double freedom_1, double freedom_2) {
    ASSERT_GE(f_deviate_bound(ratio, freedom_1, freedom_2),
              hos::f_deviate(ratio, freedom_1, freedom_2))
        << ratio << " " << freedom_1 << " " << freedom_2;
  });
  for (const double ratio : {0.0, 1e-300, 1e-12, 1e12, 1e300}) {
    EXPECT_GE(f_deviate_bound(ratio, 2.0, 4.0), hos::f_deviate(ratio, 2.0, 4.0));
    EXPECT_GE(f_deviate_bound(ratio, 2e4, 2e4), hos::f_deviate(ratio, 2e4, 2e4));
  }
}

TEST(DeviateBound, IsNearWhereItDecides) {
  each_ratio([](double ratio, double freedom_1, double freedom_2) {
    const double deviate = hos::f_deviate(ratio, freedom_1, freedom_2);
    if (deviate < -1.0 || deviate > 1.5) return;
    ASSERT_LT(f_deviate_bound(ratio, freedom_1, freedom_2), deviate + 0.5);
  });
}

TEST(DeviateBound, OfNoNumberIsNone) {
  EXPECT_TRUE(std::isnan(f_deviate_bound(loopscope::tests::kNaN, 5.0, 7.0)));
  EXPECT_EQ(f_deviate_bound(HUGE_VAL, 5.0, 7.0) < 2.0, false);
}

}  // namespace
}  // namespace loopscope::core::loop
