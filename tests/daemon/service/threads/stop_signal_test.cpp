#include "daemon/service/threads/stop_signal.hpp"

#include <gtest/gtest.h>
#include <thread>

namespace loopscope::daemon {
namespace {

using namespace std::chrono_literals;

TEST(StopSignal, WithoutItAPauseIsWhole) {
  StopSignal bell;
  const auto start = std::chrono::steady_clock::now();
  EXPECT_TRUE(bell.sleep_for(20ms));
  EXPECT_GE(std::chrono::steady_clock::now() - start, 20ms);
}

TEST(StopSignal, EndsAPauseAtOnceAndEveryLaterOne) {
  StopSignal bell;
  std::jthread ringer([&] {
    std::this_thread::sleep_for(20ms);
    bell.ring();
  });
  EXPECT_FALSE(bell.sleep_for(1h));
  EXPECT_FALSE(bell.sleep_for(1h));
  EXPECT_TRUE(bell.rung());
}

}  // namespace
}  // namespace loopscope::daemon
