#include "daemon/service/batches/kept_windows.hpp"

#include <gtest/gtest.h>

#include "tests/daemon/service/batches/kept_windows_worker.hpp"

namespace loopscope::daemon::kept_windows_tests {
namespace {

/// Two loops of a plant that nobody disturbs.
struct KeptWindowsOfACalmPlant : testing::Test {
  KeptWindowsOfACalmPlant() {
    for (const char* tag : {"1.SP", "1.PV", "1.OP", "2.PV", "2.OP"}) {
      for (std::int64_t k = -4 * kWindow_s; k <= 20 * kPeriod_s; ++k)
        archive.rows(tag).emplace((kFirstSlot_s + k) * kSecond_us, static_cast<double>(k % 7));
    }
  }
  /// Returns whether the first loop's window was read whole.
  bool visit(std::int64_t slot, Worker& worker) {
    storage::ClaimedLoop* loop = &loops.claims[0];
    const std::int64_t end_us = (kFirstSlot_s + slot * kPeriod_s) * kSecond_us;
    loop->database_now_us = end_us;
    const auto whole = worker.visit(std::span(&loop, 1), end_us, archive, results);
    loop->last_slot_end_us = end_us;
    return whole.contains(loop->loop.loop_id);
  }
  Archive archive;
  Loops loops;
  Results results;
};

TEST_F(KeptWindowsOfACalmPlant, WindowsAreReadWholeByTurns) {
  Worker worker(settings_with(1));
  std::vector<std::int64_t> whole;
  for (std::int64_t slot = 0; slot < 20; ++slot) {
    if (visit(slot, worker)) whole.push_back(slot);
  }
  EXPECT_EQ(whole, (std::vector<std::int64_t>{0, 1, 7, 13, 19})) << "the first, then every sixth";
}

TEST_F(KeptWindowsOfACalmPlant, AnotherWorkersSlotMakesAWholeRead) {
  Worker worker(settings_with(1)), other(settings_with(1));
  static_cast<void>(visit(1, worker));
  EXPECT_FALSE(visit(2, worker));
  EXPECT_TRUE(visit(3, other));
  EXPECT_TRUE(visit(4, worker));
}

// Rows that the kept ones do not know of may be behind it.
TEST_F(KeptWindowsOfACalmPlant, AnAnalysisByOtherRowsMakesAWholeRead) {
  Worker worker(settings_with(1));
  static_cast<void>(visit(1, worker));
  results.begin()->second = "revised by another worker";
  EXPECT_TRUE(visit(2, worker));
}

TEST_F(KeptWindowsOfACalmPlant, OtherFactsOrSettingsMakeAWholeRead) {
  Worker worker(settings_with(1));
  static_cast<void>(visit(1, worker));
  loops.claims[0].loop.pv_range = core::signal::OpRange{0.0, 50.0};
  EXPECT_TRUE(visit(2, worker));
  EXPECT_FALSE(visit(3, worker));
  auto moved = std::make_shared<config::Settings>(*worker.settings);
  moved->historians[0].table = "public.other";
  worker.settings = moved;
  EXPECT_TRUE(visit(4, worker));
}

TEST_F(KeptWindowsOfACalmPlant, AHistorianThatTheSettingsOfBeforeLackMakesAWholeRead) {
  Worker worker(settings_with(1));
  static_cast<void>(visit(1, worker));
  auto moved = std::make_shared<config::Settings>(*worker.settings);
  moved->historians[0].name = "new";
  worker.settings = moved;
  loops.claims[0].loop.source = "new";
  EXPECT_TRUE(visit(2, worker));
  EXPECT_FALSE(visit(3, worker));
}

TEST_F(KeptWindowsOfACalmPlant, ASlotThatMovesByMostOfItsWindowIsNotKept) {
  Worker worker(settings_with(1));
  loops.claims[0].loop.period_s = 0.6 * kWindow_s;
  static_cast<void>(visit(1, worker));
  EXPECT_EQ(worker.cache->size().loops, 0U);
}

}  // namespace
}  // namespace loopscope::daemon::kept_windows_tests
