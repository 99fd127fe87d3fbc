#include "tests/effects/noise_family.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "tests/effects/generator.hpp"

namespace loopscope::tests::effects {
namespace {

struct Moments {
  double mean_square = 0.0;
  double kurtosis = 0.0;    ///< of what it makes of normal noise
  double clustering = 0.0;  ///< correlation of squares of neighbours
};

Moments moments_of(NoiseFamily family) {
  constexpr int kCount = 400000;
  Volatility volatility(family, 1);
  Random random(2);
  double second = 0.0, fourth = 0.0, product = 0.0, scale = 0.0, before = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const double size = volatility.next();
    const double square = std::pow(size * random.normal(), 2);
    scale += size * size / kCount;
    second += square / kCount;
    fourth += square * square / kCount;
    product += square * before / kCount;
    before = square;
  }
  return {scale, fourth / (second * second),
          (product - second * second) / (fourth - second * second)};
}

TEST(NoiseFamily, EachHasVarianceOneAndTailsOfItsOwn) {
  EXPECT_NEAR(moments_of(NoiseFamily::gaussian).mean_square, 1.0, 1e-9);
  for (const NoiseFamily family : {NoiseFamily::t5, NoiseFamily::bursts, NoiseFamily::garch}) {
    const Moments moments = moments_of(family);
    EXPECT_NEAR(moments.mean_square, 1.0, 0.05);
    EXPECT_GT(moments.kurtosis, 3.5);
    EXPECT_EQ(moments.clustering > 0.05, family != NoiseFamily::t5);
  }
}

TEST(NoiseFamily, HasAWordEach) {
  EXPECT_EQ(noise_family_of("bursts"), NoiseFamily::bursts);
  EXPECT_FALSE(noise_family_of("loud"));
}

TEST(NoiseFamily, ChangesTheNoiseOfARecordAndNotItsLoop) {
  const Record plain = generate("healthy_still", 3);
  const Record loud = generate("healthy_still", 3, Size::realistic, NoiseFamily::bursts);
  EXPECT_NE(plain.pv, loud.pv);
  EXPECT_EQ(plain.sp, loud.sp);
  EXPECT_EQ(plain.truth.loop.gain, loud.truth.loop.gain);
}

}  // namespace
}  // namespace loopscope::tests::effects
