#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>

namespace loopscope::core::hos {

/// FFTW's planner must not run in two threads: one lock for all plans of the program. It is the one
/// thing in core that all threads share.
[[nodiscard]] std::mutex& planner_lock();

/// The plan of one kind for one key (a length), made from it at its first use and kept for the life
/// of the program (a few kilobytes each).
template <class Plan, class Key = std::size_t>
const Plan& cached_plan(const Key& key) {
  static std::map<Key, std::unique_ptr<const Plan>> plans;
  const std::lock_guard lock(planner_lock());
  std::unique_ptr<const Plan>& plan = plans[key];
  if (!plan) plan = std::make_unique<const Plan>(key);
  return *plan;
}

}  // namespace loopscope::core::hos
