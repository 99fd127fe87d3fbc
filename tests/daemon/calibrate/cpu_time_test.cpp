#include "daemon/calibrate/cpu_time.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <thread>

namespace loopscope::daemon {
namespace {

TEST(CpuTime, CountsWorkAndNotWaiting) {
  const double start_s = thread_cpu_s();
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  const double slept_s = thread_cpu_s() - start_s;
  EXPECT_LT(slept_s, 0.1);
  while (thread_cpu_s() - start_s < slept_s + 0.01) {
  }
  EXPECT_GE(thread_cpu_s() - start_s, slept_s + 0.01);
}

}  // namespace
}  // namespace loopscope::daemon
