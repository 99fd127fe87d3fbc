#include "tests/plants/watched_loop.hpp"

#include <gtest/gtest.h>
#include <span>

#include "tests/effects/generator.hpp"
#include "tests/effects/scenario.hpp"

namespace loopscope::tests::plants {
namespace {

using effects::kSamples;

TEST(WatchedLoop, TellsOfEverySlotHowLongOpWasAtItsLimit) {
  PlantLoop loop;
  loop.record = "valve_saturation";
  loop.fault = "valve_saturation";
  loop.seed = 1;
  const WatchedLoop watched = watch_loop(loop, {.windows = 2, .onset_windows = 1});
  const effects::Record record =
      effects::generate_onset(loop.record, loop.seed, 2 * kSamples, kSamples);
  ASSERT_EQ(watched.slots.size(), 2 * kSlotsInWindow + 1);
  ASSERT_EQ(watched.at_limit.size(), watched.slots.size());
  for (std::size_t slot = 0; slot < watched.slots.size(); ++slot) {
    const std::span<const double> op =
        std::span(record.op).subspan(slot * kSamples / kSlotsInWindow, kSamples);
    EXPECT_EQ(watched.at_limit[slot], effects::share_at_limit(op)) << slot;
  }
  EXPECT_LE(watched.at_limit.front(), effects::kMostAtLimit);
  EXPECT_GT(watched.at_limit.back(), effects::kMostAtLimit);
}

}  // namespace
}  // namespace loopscope::tests::plants
