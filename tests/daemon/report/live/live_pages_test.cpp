#include "daemon/report/live/live_pages.hpp"

#include <atomic>
#include <chrono>
#include <gtest/gtest.h>
#include <memory>
#include <thread>

namespace loopscope::daemon {
namespace {

using namespace std::chrono_literals;

bool comes_true(const std::function<bool()>& what) {
  for (int look = 0; look < 400 && !what(); ++look) std::this_thread::sleep_for(50ms);
  return what();
}

/// Nobody listens there: what is read shows by the settings that are asked for.
std::shared_ptr<const config::Settings> without_database() {
  auto settings = std::make_shared<config::Settings>();
  settings->results.connection = "host=127.0.0.1 port=1 connect_timeout=1";
  return settings;
}

TEST(LivePages, ReadNothingByThemselvesWhileTheyRest) {
  const auto settings = without_database();
  std::atomic<int> asked = 0, looks = 0;
  std::atomic<bool> rests = true;
  const LivePages pages(
      [&] {
        ++asked;
        return settings;
      },
      [&] {
        ++looks;
        return rests.load();
      });
  ASSERT_TRUE(comes_true([&] { return looks >= 2; }));
  EXPECT_EQ(asked, 0);
  rests = false;
  EXPECT_TRUE(comes_true([&] { return asked >= 1; }));
}

}  // namespace
}  // namespace loopscope::daemon
