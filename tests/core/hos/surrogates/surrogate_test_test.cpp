#include "core/hos/surrogates/surrogate_test.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "core/hos/numeric/normal_draw.hpp"
#include "tests/core/hos/rejections.hpp"
#include "tests/core/hos/uniformity.hpp"
#include "tests/support/chance.hpp"

namespace loopscope::core::hos {
namespace {

using loopscope::tests::four_errors;

/// p of a record whose surrogates are of its own kind: -ln p is exponential with mean `spread`.
double p_among_equals(double spread, std::mt19937_64& random) {
  const auto draw = [&] { return std::pow(1.0 - uniform_draw(random), spread); };
  SurrogateP asked(draw());
  while (!asked.settled()) asked.add(draw());
  return asked.p();
}

TEST(HosSurrogateP, HoldsItsLevelWhateverTheNoiseMakesOfTheFirstPass) {
  const int records = tests::records(40'000);
  for (const double spread : {1.0, 5.0, 40.0}) {
    std::mt19937_64 random(7);
    std::vector<double> p;
    for (int i = 0; i < records; ++i) p.push_back(p_among_equals(spread, random));
    for (const auto& [level, most] : {std::pair{0.05, 0.05}, std::pair{0.01, 0.012},
                                      std::pair{1e-3, 1.5e-3}, std::pair{1e-4, 3e-4}}) {
      const double share = tests::share_below(p, level);
      std::printf("| %4.0f | %g | %.5f |\n", spread, level, share);
      EXPECT_LE(share, most + four_errors(most, records)) << spread << ' ' << level;
    }
  }
}

TEST(HosSurrogateP, StopsAtTheFirstEarlyOneAndTheSecondLaterOne) {
  SurrogateP early(0.01);
  early.add(0.5);
  EXPECT_FALSE(early.settled());
  early.add(0.001);
  EXPECT_TRUE(early.settled());
  EXPECT_DOUBLE_EQ(early.p(), 0.5);
  SurrogateP late(0.01);
  for (std::size_t i = 0; i < SurrogateP::kEarly; ++i) late.add(0.5);
  late.add(0.001);
  EXPECT_FALSE(late.settled());
  for (int i = 0; i < 8; ++i) late.add(0.5);
  late.add(0.002);
  EXPECT_TRUE(late.settled());
  EXPECT_DOUBLE_EQ(late.p(), 0.1);
  late.add(0.002);
  EXPECT_DOUBLE_EQ(late.p(), 0.1) << "what comes after does not count";
}

TEST(HosSurrogateP, BeyondTheDrawsTheTailGoesOn) {
  SurrogateP far(1e-40);
  SurrogateP farther(1e-80);
  std::mt19937_64 random(3);
  while (!far.settled()) {
    const double p = 1.0 - uniform_draw(random);
    far.add(p);
    farther.add(p);
  }
  EXPECT_LT(far.p(), 1e-15);
  EXPECT_LT(farther.p(), far.p());
  EXPECT_GE(far.p(), 1e-40) << "never below the first pass";
}

TEST(HosSurrogateP, WithoutADrawTheFirstPassStands) {
  EXPECT_EQ(SurrogateP(0.3).p(), 0.3);
}

TEST(HosSurrogateTest, AsksOnlyWhatIsUnclear) {
  const CouplingTests found{.mean_p = 1e-3, .nli_p = 0.4, .cubic_p = std::nullopt};
  int draws = 0;
  const CouplingTests held = against_surrogates(found, 0.05, [&](bool harmonics) {
    EXPECT_FALSE(harmonics);
    return CouplingTests{.mean_p = ++draws == 4 ? 1e-4 : 0.5, .nli_p = 1e-9, .cubic_p = 1e-9};
  });
  EXPECT_EQ(draws, 4);
  EXPECT_DOUBLE_EQ(held.mean_p, 0.25);
  EXPECT_EQ(held.nli_p, 0.4);
  EXPECT_FALSE(held.cubic_p.has_value());
}

}  // namespace
}  // namespace loopscope::core::hos
