#include <cstdio>
#include <gtest/gtest.h>

#include "tests/plants/diagnosed_loop.hpp"
#include "tests/plants/flags.hpp"
#include "tests/plants/plant_score.hpp"
#include "tests/support/chance.hpp"
#include "tests/support/long_run.hpp"

namespace loopscope::tests::plants {
namespace {

/// Three plants of 60 loops with each kind of fault once; one in the short form. Of the long run
/// (README.md) 96 % of the faults are right: fewer than 19 of 24 happen once in a thousand such
/// draws, more than three false flags once in a hundred.
TEST(ReducedPlant, KeepsTheFigureFromRotting) {
  constexpr PlantSize kSize = {60, 8};
  const std::size_t plants = (records(3 * kSize.loops) + kSize.loops - 1) / kSize.loops;
  std::size_t right = 0, false_flags = 0;
  for (std::uint64_t seed = 70001; seed <= 70000 + plants; ++seed) {
    const std::vector<PlantLoop> plant = draw_plant(seed, kSize);
    const PlantScore result = score(plant, flags_of(plant, diagnose_plant(plant, 2)));
    right += result.right;
    false_flags += result.false_flags;
    for (const std::string& miss : result.misses) std::printf("%s\n", miss.c_str());
  }
  constexpr double kFalse = 0.0052;  // of a healthy loop
  EXPECT_GE(right, fewest(0.96, plants * kSize.faulty, 1e-3));
  EXPECT_LE(false_flags, most(kFalse, plants * (kSize.loops - kSize.faulty), 1e-2));
}

}  // namespace
}  // namespace loopscope::tests::plants
