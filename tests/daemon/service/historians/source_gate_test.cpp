#include "daemon/service/historians/source_gate.hpp"

#include <atomic>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <thread>
#include <vector>

namespace loopscope::daemon {
namespace {

using namespace std::chrono_literals;
using storage::DatabaseError;
using storage::Remedy;
using testing::HasSubstr;

const DatabaseError kDown("connection refused, historian plant", "start it", Remedy::reconnect);

TEST(SourceGate, LetsNoMoreInsideThanTheLimit) {
  SourceGate gate;
  std::atomic<int> inside = 0;
  std::atomic<int> most = 0;
  {
    std::vector<std::jthread> users;
    for (int k = 0; k < 8; ++k) {
      users.emplace_back([&] {
        for (int round = 0; round < 50; ++round) {
          gate.enter("plant", 3, 10s);
          const int now = ++inside;
          for (int seen = most; now > seen && !most.compare_exchange_weak(seen, now);) continue;
          std::this_thread::yield();
          --inside;
          gate.leave();
        }
      });
    }
  }
  EXPECT_LE(most, 3);
  EXPECT_EQ(gate.inside(), 0);
}

TEST(SourceGate, WhoGetsNoPlaceIsToldAfterItsPatience) {
  SourceGate gate;
  gate.enter("plant", 1, 1s);
  try {
    gate.enter("plant", 1, 20ms);
    FAIL();
  } catch (const DatabaseError& error) {
    EXPECT_STREQ(error.what(),
                 "the only connection is in use and did not come free within 0 s, historian plant");
    EXPECT_EQ(error.hint(), "raise max_connections of this historian, or lower /daemon/workers");
    EXPECT_EQ(error.remedy(), Remedy::retry);
  }
  gate.leave();
  gate.enter("plant", 2, 1s);
  gate.enter("plant", 2, 1s);
  try {
    gate.enter("plant", 2, 1ms);
    FAIL();
  } catch (const DatabaseError& error) {
    EXPECT_STREQ(error.what(),
                 "all 2 connections are in use and none came free within 0 s, historian plant");
  }
}

TEST(SourceGate, ASourceThatIsDownTurnsEverybodyAwayAtOnce) {
  SourceGate gate;
  gate.enter("plant", 1, 1s);
  std::string said;
  std::jthread waiting([&] {
    try {
      gate.enter("plant", 1, 30s);
    } catch (const DatabaseError& error) {
      said = error.what();
    }
  });
  std::this_thread::sleep_for(20ms);
  gate.leave_down(kDown, 30s);
  waiting.join();
  EXPECT_EQ(said, kDown.what()) << "and it does not wait for its patience";
  EXPECT_TRUE(gate.is_down());
  EXPECT_THROW(gate.enter("plant", 1, 1s), DatabaseError);
}

TEST(SourceGate, AfterThePauseOneTriesAndItsLuckCountsForAll) {
  SourceGate gate;
  gate.enter("plant", 4, 1s);
  gate.leave_down(kDown, 0s);
  gate.enter("plant", 4, 1s);
  EXPECT_THROW(gate.enter("plant", 4, 1s), DatabaseError) << "one tries";
  gate.leave();
  EXPECT_FALSE(gate.is_down());
  gate.enter("plant", 4, 1s);
  gate.enter("plant", 4, 1s);
  EXPECT_EQ(gate.inside(), 2);
}

}  // namespace
}  // namespace loopscope::daemon
