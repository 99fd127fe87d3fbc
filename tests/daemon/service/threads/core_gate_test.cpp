#include "daemon/service/threads/core_gate.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <gtest/gtest.h>
#include <thread>
#include <vector>

namespace loopscope::daemon {
namespace {

TEST(CoreGate, AdmitsAsManyAsThereAreCores) {
  CoreGate gate(2);
  std::atomic<int> inside = 0;
  std::atomic<int> most = 0;
  {
    std::vector<std::jthread> workers;
    for (int worker = 0; worker < 6; ++worker) {
      workers.emplace_back([&] {
        for (int round = 0; round < 20; ++round) {
          const CoreGate::Permit permit(gate);
          const int now = ++inside;
          int seen = most;
          while (now > seen && !most.compare_exchange_weak(seen, now)) {
          }
          std::this_thread::sleep_for(std::chrono::microseconds(200));
          --inside;
        }
      });
    }
  }
  EXPECT_EQ(most, 2);
  EXPECT_EQ(inside, 0);
}

}  // namespace
}  // namespace loopscope::daemon
