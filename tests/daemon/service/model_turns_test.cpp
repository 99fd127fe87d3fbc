#include "daemon/service/model_turns.hpp"

#include <gtest/gtest.h>
#include <map>

namespace loopscope::daemon {
namespace {

constexpr std::int64_t kHour_us = 3'600'000'000;

storage::ClaimedLoop loop_number(std::int64_t number, const std::string& last_verdict = "healthy") {
  storage::ClaimedLoop claim;
  claim.loop.loop_id = number;
  claim.loop.period_s = 3600.0;
  claim.last_verdict = last_verdict;
  return claim;
}

config::ScheduleSettings large_plant() {
  config::ScheduleSettings schedule;
  schedule.model_all_up_to = 500;
  schedule.model_every_slots = 10;
  return schedule;
}

ModelWish wish(const storage::ClaimedLoop& claim, std::int64_t slot, std::size_t loops = 501) {
  return model_wish(large_plant(), loops, claim, slot * kHour_us);
}

TEST(ModelTurns, EveryLoopOfASmallPlant) {
  for (std::int64_t number = 1; number <= 20; ++number) {
    EXPECT_EQ(wish(loop_number(number), 7, 500), ModelWish::always);
  }
}

TEST(ModelTurns, ATenthOfALargeOneInEverySlot) {
  for (std::int64_t slot = 490'000; slot < 490'005; ++slot) {
    int turns = 0;
    for (std::int64_t number = 1; number <= 1000; ++number) {
      turns += wish(loop_number(number), slot) == ModelWish::always ? 1 : 0;
    }
    EXPECT_EQ(turns, 100);
  }
}

TEST(ModelTurns, EachLoopOnceInTenSlots) {
  for (std::int64_t number = 1; number <= 30; ++number) {
    int turns = 0;
    for (std::int64_t slot = 490'000; slot < 490'010; ++slot) {
      turns += wish(loop_number(number), slot) == ModelWish::always ? 1 : 0;
    }
    EXPECT_EQ(turns, 1) << number;
  }
}

/// What a model found is not dropped for want of one in the next slot.
TEST(ModelTurns, AlwaysWhereTheLastVerdictWasAFault) {
  for (std::int64_t slot = 490'000; slot < 490'010; ++slot) {
    EXPECT_EQ(wish(loop_number(3, "valve_stiction"), slot), ModelWish::always);
    EXPECT_EQ(wish(loop_number(3, "unexplained"), slot), ModelWish::always);
  }
  for (const char* verdict : {"", "healthy", "insufficient_data"}) {
    int turns = 0;
    for (std::int64_t slot = 490'000; slot < 490'010; ++slot) {
      turns += wish(loop_number(3, verdict), slot) == ModelWish::always ? 1 : 0;
    }
    EXPECT_EQ(turns, 1) << verdict;
  }
}

TEST(ModelTurns, PeriodsOfPartsOfASecondHaveTurnsToo) {
  storage::ClaimedLoop claim = loop_number(1);
  claim.loop.period_s = 1.5;
  int turns = 0;
  for (std::int64_t slot = 0; slot < 100; ++slot) {
    turns += model_wish(large_plant(), 501, claim, slot * 1'500'000) == ModelWish::always ? 1 : 0;
  }
  EXPECT_EQ(turns, 10);
}

}  // namespace
}  // namespace loopscope::daemon
