#include "core/hos/surrogates/innovation_test.hpp"

#include <cstdio>
#include <gtest/gtest.h>
#include <string_view>
#include <utility>
#include <vector>

#include "core/hos/surrogates/slow_wander.hpp"
#include "tests/core/hos/family_rates.hpp"
#include "tests/core/hos/rejections.hpp"
#include "tests/core/hos/signals.hpp"
#include "tests/core/hos/uniformity.hpp"
#include "tests/support/chance.hpp"

namespace loopscope::core::hos {
namespace {

using loopscope::tests::four_errors;

InnovationTest test(const std::vector<double>& signal) {
  const auto steady = without_slow_wander(signal);
  return test_innovations(steady, Innovations::of(steady)->reweighted(steady));
}

std::vector<double> p_of(std::string_view name, int records) {
  std::vector<double> p;
  for (int seed = 1; seed <= records; ++seed) {
    const auto& family = tests::family(name);
    p.push_back(test(family.draw(family.samples, 700'000U + static_cast<std::uint64_t>(seed))).p());
  }
  std::printf("| %-34s | %5.1f | %5.1f |\n", std::string(name).c_str(),
              100.0 * tests::share_below(p, 0.05), 100.0 * tests::share_below(p, 0.01));
  return p;
}

/// Lines and slow loads beside heavy tails among them: their best prediction is not linear.
TEST(HosInnovationTest, HoldsItsLevelOnLinearRecords) {
  const int records = tests::records(100);
  for (const auto* const name :
       {"white", "random_walk", "sinusoid_20_at_20_db", "paper_5_1", "paper_5_3", "ar1_0.9_gaps",
        "ar1_0.9_1000", "ar1_0.9_exponential", "ar1_0.9_student_3", "ar1_0.9_bursts",
        "resonance_20_pole_0.97_garch", "ar1_0.9_one_step", "integrated_walk"}) {
    const auto p = p_of(name, records);
    EXPECT_LE(tests::share_below(p, 0.05), 0.09 + four_errors(0.09, records)) << name;
    EXPECT_LE(tests::share_below(p, 0.01), 0.025 + four_errors(0.025, records)) << name;
  }
}

TEST(HosInnovationTest, SeesAValveThatSticks) {
  const int records = tests::records(40);
  for (const auto* const name : {"paper_5_4", "paper_5_4_kano"}) {
    EXPECT_GE(tests::share_below(p_of(name, records), 0.01), 0.9 - four_errors(0.1, records))
        << name;
  }
}

TEST(HosInnovationTest, TellsSquaresFromCubes) {
  const auto squared = test(tests::family("paper_4_1_nonlinear").draw(4096, 3));
  EXPECT_LT(squared.even_p, 1e-3);
  EXPECT_GT(squared.odd_p, squared.even_p);
  const auto triangle = test(tests::family("triangle_30").draw(4096, 3));
  EXPECT_LT(triangle.odd_p, 1e-3);
  EXPECT_GT(triangle.even_p, triangle.odd_p);
}

TEST(HosInnovationTest, DoesNotDependOnUnitAndOffset) {
  const auto record = tests::family("paper_5_4").draw(4096, 4);
  const InnovationTest before = test(record);
  const InnovationTest after = test(tests::affine(record, -0x1p10, 0x1p12));
  EXPECT_NEAR(std::log(after.odd_p), std::log(before.odd_p), 1e-3);
}

TEST(HosInnovationTest, TooFewSamplesSayNothing) {
  const auto record = tests::white_noise(1, 120);
  EXPECT_EQ(
      test_innovations(record, Innovations::of(record, best_kernels(), {.largest = 24}).value())
          .p(),
      test_innovations(record, Innovations::of(record).value()).p());
}

}  // namespace
}  // namespace loopscope::core::hos
