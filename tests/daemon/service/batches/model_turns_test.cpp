#include "daemon/service/batches/model_turns.hpp"

#include <gtest/gtest.h>
#include <optional>

#include "tests/daemon/times.hpp"

namespace loopscope::daemon {
namespace {

using core::diagnosis::VerdictCode;

storage::ClaimedLoop loop_number(std::int64_t number,
                                 std::optional<storage::LastVerdict> last_verdict = {}) {
  storage::ClaimedLoop claim;
  claim.loop.loop_id = number;
  claim.loop.period_s = 3600.0;
  claim.last_verdict = last_verdict;
  return claim;
}

config::Settings large_plant() {
  config::Settings settings;
  settings.schedule.model_all_up_to = 500;
  settings.schedule.model_every_slots = 10;
  settings.flags.false_discovery_rate = 0.05;
  settings.flags.min_confidence = 0.3;
  return settings;
}

/// Whether the loop gets a model whatever its statistics say.
bool always(const storage::ClaimedLoop& claim, std::int64_t slot, std::size_t loops = 501) {
  return !model_wish(large_plant(), loops, claim, slot * kHour_us).cause;
}

/// Share of a thousand slots.
double share_of_turns(const storage::ClaimedLoop& claim) {
  int turns = 0;
  for (std::int64_t slot = 0; slot < 1000; ++slot) turns += always(claim, slot) ? 1 : 0;
  return turns / 1000.0;
}

TEST(ModelTurns, EveryLoopOfASmallPlant) {
  for (std::int64_t number = 1; number <= 20; ++number) {
    EXPECT_TRUE(always(loop_number(number), 7, 500));
  }
}

TEST(ModelTurns, ATenthOfALargeOneInEverySlot) {
  for (std::int64_t slot = 490'000; slot < 490'005; ++slot) {
    int turns = 0;
    for (std::int64_t number = 1; number <= 10'000; ++number) {
      turns += always(loop_number(number), slot) ? 1 : 0;
    }
    EXPECT_NEAR(turns, 1000, 120) << "four standard deviations";
  }
}

/// Visits may come every hour, every day, or whenever there is time: 300 of them leave out one loop
/// in 5e13.
TEST(ModelTurns, EveryLoopHasItsTurnsWhateverTheRhythmOfVisits) {
  for (const std::int64_t step : {1, 8, 10, 24, 240}) {
    for (std::int64_t number = 1; number <= 50; ++number) {
      int turns = 0;
      for (int visit = 0; visit < 300; ++visit) {
        turns += always(loop_number(number), 490'000 + step * visit) ? 1 : 0;
      }
      EXPECT_NEAR(turns, 30, 26) << "loop " << number << ", every " << step << " slots";
    }
  }
}

/// What a model found is not dropped for want of one in the next slot.
TEST(ModelTurns, AlwaysWhereTheLastVerdictWouldBeFlagged) {
  using Last = storage::LastVerdict;
  EXPECT_EQ(share_of_turns(loop_number(3, Last{VerdictCode::valve_stiction, 0.8, 1e-6})), 1.0);
  EXPECT_EQ(share_of_turns(loop_number(3, Last{VerdictCode::valve_saturation, 0.5, {}})), 1.0);
  EXPECT_NEAR(share_of_turns(loop_number(3, Last{VerdictCode::nonlinear_unexplained, 0.5, 0.03})),
              0.1, 0.05)
      << "one loop in thirty has that by chance";
  EXPECT_NEAR(share_of_turns(loop_number(3, Last{VerdictCode::unexplained, 0.2, {}})), 0.1, 0.05)
      << "less sure than what is flagged";
  EXPECT_NEAR(share_of_turns(loop_number(3, Last{VerdictCode::healthy, 0.6, {}})), 0.1, 0.05);
  EXPECT_EQ(share_of_turns(loop_number(3, Last{VerdictCode::insufficient_data, 1.0, {}})), 1.0)
      << "what was found before may still stand";
}

TEST(ModelTurns, TheCauseIsWhatWouldBeFlagged) {
  std::int64_t slot = 490'000;
  while (always(loop_number(3), slot)) ++slot;
  const auto cause = model_wish(large_plant(), 501, loop_number(3), slot * kHour_us).cause;
  ASSERT_TRUE(cause);
  EXPECT_DOUBLE_EQ(cause->largest_p, 0.005);
  EXPECT_DOUBLE_EQ(cause->least_confidence, 0.3);
}

TEST(ModelTurns, PeriodsOfPartsOfASecondHaveTurnsToo) {
  storage::ClaimedLoop claim = loop_number(1);
  claim.loop.period_s = 1.5;
  int turns = 0;
  for (std::int64_t slot = 0; slot < 1000; ++slot) {
    turns += model_wish(large_plant(), 501, claim, slot * 1'500'000).cause ? 0 : 1;
  }
  EXPECT_NEAR(turns, 100, 40);
}

}  // namespace
}  // namespace loopscope::daemon
