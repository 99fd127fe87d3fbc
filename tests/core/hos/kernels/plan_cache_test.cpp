#include "core/hos/kernels/plan_cache.hpp"

#include <atomic>
#include <gtest/gtest.h>
#include <thread>
#include <vector>

namespace loopscope::core::hos {
namespace {

struct CountedPlan {
  explicit CountedPlan(std::size_t size) : length(size) { ++made; }
  std::size_t length;
  static inline std::atomic<int> made = 0;
};

TEST(HosPlanCache, MakesEachPlanOnceWhateverTheThreads) {
  std::vector<const CountedPlan*> found(16);
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < found.size(); ++i) {
      threads.emplace_back([&found, i] { found[i] = &cached_plan<CountedPlan>(64 + i % 2); });
    }
  }
  EXPECT_EQ(CountedPlan::made, 2);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i], found[i % 2]);
    EXPECT_EQ(found[i]->length, 64 + i % 2);
  }
}

}  // namespace
}  // namespace loopscope::core::hos
