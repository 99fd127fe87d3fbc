#include "daemon/service/threads/in_threads.hpp"

#include <algorithm>
#include <atomic>
#include <gtest/gtest.h>
#include <stdexcept>
#include <vector>

namespace loopscope::daemon {
namespace {

TEST(InThreads, DoesEveryIndexOnce) {
  for (const std::size_t threads : {1U, 3U, 50U}) {
    std::vector<std::atomic<int>> done(20);
    std::atomic<std::size_t> makers = 0;
    in_threads(done.size(), threads, [&]() -> IndexedTask {
      ++makers;
      return [&](std::size_t index) { ++done[index]; };
    });
    EXPECT_TRUE(std::ranges::all_of(done, [](const auto& count) { return count == 1; }));
    EXPECT_LE(makers, std::min<std::size_t>(threads, done.size()));
  }
}

TEST(InThreads, NothingToDo) {
  std::atomic<int> done = 0;
  in_threads(0, 4, [&]() -> IndexedTask { return [&](std::size_t /*index*/) { ++done; }; });
  EXPECT_EQ(done, 0);
}

TEST(InThreads, AFailureEndsTheWork) {
  std::atomic<std::size_t> done = 0;
  const auto fail_at_ten = [&]() -> IndexedTask {
    return [&](std::size_t index) {
      if (index == 10) throw std::runtime_error("ten");
      ++done;
    };
  };
  EXPECT_THROW(in_threads(1'000'000'000, 2, fail_at_ten), std::runtime_error);
  EXPECT_LT(done, 1'000'000'000U);
}

}  // namespace
}  // namespace loopscope::daemon
