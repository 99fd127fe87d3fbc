#include "core/hos/kernels/plan_cache.hpp"

namespace loopscope::core::hos {

std::mutex& planner_lock() {
  static std::mutex lock;
  return lock;
}

}  // namespace loopscope::core::hos
