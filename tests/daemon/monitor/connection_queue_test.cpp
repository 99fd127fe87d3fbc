#include "daemon/monitor/connection_queue.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <latch>
#include <semaphore>

namespace loopscope::daemon {
namespace {

using namespace std::chrono_literals;

TEST(ConnectionQueue, ServesEverybody) {
  std::atomic<int> served = 0;
  {
    ConnectionQueue queue(3, 4);
    for (int number = 0; number < 1000; ++number) queue.push([&] { ++served; });
  }
  EXPECT_EQ(served, 1000);
}

TEST(ConnectionQueue, IsCrowdedWhileSomebodyWaits) {
  ConnectionQueue queue(2, 4);
  std::latch begun(2);
  std::counting_semaphore<8> go(0);
  const auto serve = [&] { go.acquire(); };
  for (int number = 0; number < 2; ++number) {
    queue.push([&] {
      begun.count_down();
      go.acquire();
    });
  }
  begun.wait();
  EXPECT_FALSE(queue.crowded());
  queue.push(serve);
  EXPECT_TRUE(queue.crowded());
  go.release(3);
  queue.shut_down();
  EXPECT_FALSE(queue.crowded());
}

TEST(ConnectionQueue, TakesNoMoreThanItsPlaces) {
  ConnectionQueue queue(1, 2);
  std::latch begun(1);
  std::counting_semaphore<8> go(0);
  queue.push([&] {
    begun.count_down();
    go.acquire();
  });
  begun.wait();
  std::atomic<int> pushed = 0;
  std::jthread pusher([&] {
    for (int number = 0; number < 4; ++number) {
      queue.push([&] { go.acquire(); });
      ++pushed;
    }
  });
  while (pushed < 2) std::this_thread::sleep_for(1ms);
  std::this_thread::sleep_for(50ms);
  EXPECT_EQ(pushed, 2);
  go.release(5);
  pusher.join();
  EXPECT_EQ(pushed, 4);
}

}  // namespace
}  // namespace loopscope::daemon
